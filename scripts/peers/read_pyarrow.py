"""Reading a motions file into memory by pyarrow: what simulate is measured against.

    python read_pyarrow.py MOTIONS.parquet --threads 2

Three times: a whole process that reads the file and ends, the first read in such a process (which pays for
the memory it gets from the system), and later reads in one process.
"""

import argparse
import os
import statistics
import subprocess
import sys
import time


def read_seconds(path, threads, repeat):
    """The wall times of reading the whole file, one read after the other, and the last table."""
    import pyarrow
    import pyarrow.dataset  # which the first read would else import
    import pyarrow.parquet as pq

    pyarrow.set_cpu_count(threads)
    pyarrow.set_io_thread_count(threads)
    seconds = []
    for _ in range(repeat):
        table = None
        start = time.perf_counter()
        table = pq.read_table(path, use_threads=threads > 1)
        seconds.append(time.perf_counter() - start)
    return seconds, table


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("motions", help="Parquet file")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--repeat", type=int, default=7, help="runs, of which the median counts")
    parser.add_argument("--once", action="store_true", help="read once, in this very process")
    options = parser.parse_args()
    if options.once:
        print(read_seconds(options.motions, options.threads, 1)[0][0])
        return
    command = [sys.executable, __file__, options.motions, "--once", "--threads", str(options.threads)]
    first, whole = [], []
    for _ in range(options.repeat):
        start = time.perf_counter()
        done = subprocess.run(command, capture_output=True, check=True)
        whole.append(time.perf_counter() - start)
        first.append(float(done.stdout))
    seconds, table = read_seconds(options.motions, options.threads, 1 + options.repeat)

    from common import print_report

    print_report(
        threads=options.threads,
        rows=table.num_rows,
        megabytes_in_memory=table.nbytes / 1e6,
        megabytes_of_file=os.path.getsize(options.motions) / 1e6,
        whole_process_s=statistics.median(whole),
        first_read_s=statistics.median(first),
        later_read_s=statistics.median(seconds[1:]),
    )


if __name__ == "__main__":
    main()

"""How to store accelerations: size against the speed of writing and reading, as Parquet by pyarrow on one thread.

    python scripts/encodings.py out/motions.parquet

Prints a table in Markdown. Speeds are in MB/s of single-precision samples, medians of five.
"""

import argparse
import os
import pathlib
import statistics
import tempfile
import time

import pyarrow as pa
import pyarrow.parquet as pq

COLUMN = "acceleration_m_s2"
ENCODINGS = ("PLAIN", "BYTE_STREAM_SPLIT")
CODECS = (("none", None), ("lz4", None), ("zstd", 1), ("zstd", 3))
ROWS_IN_GROUP = 128
REPEAT = 5


def seconds(work):
    """The median time of some runs."""
    times = []
    for _ in range(REPEAT):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("motions", help="motions file")
    parser.add_argument("--rows", type=int, default=3500, help="motions to store")
    options = parser.parse_args()
    lists = pq.read_table(options.motions, columns=[COLUMN])[COLUMN].slice(0, options.rows)
    megabytes = 4e-6 * sum(len(row.values) for row in lists)

    print("| type | encoding | codec | size, MB | write, MB/s | read, MB/s |\n|---|---|---|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "motions.parquet"
        for kind in (pa.float32(), pa.float64()):
            table = pa.table({COLUMN: lists.cast(pa.list_(kind))})
            for encoding in ENCODINGS:
                for codec, level in CODECS:
                    write = seconds(
                        lambda: pq.write_table(
                            table,
                            path,
                            row_group_size=ROWS_IN_GROUP,
                            use_dictionary=False,
                            write_statistics=False,
                            column_encoding=encoding,
                            compression=codec,
                            compression_level=level,
                        )
                    )
                    read = seconds(lambda: pq.read_table(path, use_threads=False))
                    name = codec if level is None else f"{codec} {level}"
                    row = (
                        str(kind),
                        encoding.lower().replace("_", " "),
                        name,
                        f"{os.path.getsize(path) / 1e6:.1f}",
                    )
                    print(
                        "| "
                        + " | ".join((*row, f"{megabytes / write:.0f}", f"{megabytes / read:.0f}"))
                        + " |"
                    )


if __name__ == "__main__":
    main()

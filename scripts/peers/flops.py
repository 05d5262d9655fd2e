"""How many floating-point operations an analysis takes: those that valgrind sees executed, a fused multiply-add as two.

    python scripts/peers/flops.py motions.parquet --rockfrag target/release/rockfrag

With AVX2, which valgrind knows; AVX-512 gives the same bits by the same operations. What is not
the solver's is the reading of the motions, where hardly any is done.
"""

import argparse
import collections
import itertools
import json
import pathlib
import re
import subprocess
import tempfile

import pyarrow.parquet as pq

MOTIONS = 8
ARITHMETIC = re.compile(r"v?(fn?m(?:add|sub)|add|sub|mul|div|sqrt|min|max)\d*([ps])d$")
WIDTHS = {"z": 8, "y": 4, "x": 2}


def grid(path):
    """The 400 structures of `cargo bench --bench solver`."""
    values = itertools.product(
        (0.5 + 0.35 * k for k in range(10)), (0.05 + 0.03 * k for k in range(10)), (0.80, 0.86, 0.92, 0.98)
    )
    lines = [f"s{number},{p},{alpha},{eta}" for number, (p, alpha, eta) in enumerate(values)]
    path.write_text("\n".join(["name,p,alpha,eta", *lines]) + "\n")


def executed(command, program, folder):
    """How often each instruction of the program was executed, by its place in the file."""
    out = folder / "callgrind.out"
    plain = ("--dump-instr=yes", "--compress-pos=no", "--compress-strings=no")
    subprocess.run(
        ["valgrind", "--tool=callgrind", *plain, f"--callgrind-out-file={out}", *map(str, command)],
        check=True,
        capture_output=True,
    )
    counts, inside, is_call = collections.Counter(), False, False
    for line in out.read_text().splitlines():
        if line.startswith("ob="):
            inside = pathlib.Path(line[3:]).name == program.name
        elif line.startswith("calls="):
            is_call = True
        elif line.startswith("0x"):
            place, _, count = line.split()[:3]
            if inside and not is_call:
                counts[int(place, 16)] += int(count)
            is_call = False
    return counts


def operations(program):
    """The floating-point operations that an instruction does, by its place in the file."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program], check=True, capture_output=True, text=True)
    of_place = {}
    for place, name, operands in re.findall(r"^\s+([0-9a-f]+):\t(\S+)[ \t]*(.*)$", listing.stdout, re.M):
        if known := ARITHMETIC.match(name):
            width = next((WIDTHS[r] for r in "zyx" if f"%{r}mm" in operands), 1)
            lanes = width if known[2] == "p" else 1
            of_place[int(place, 16)] = 2 * lanes if known[1].startswith("f") else lanes
    return of_place


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("motions", type=pathlib.Path)
    parser.add_argument("--rockfrag", type=pathlib.Path, default=pathlib.Path("target/release/rockfrag"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        motions = pq.read_table(options.motions)
        few = [k * motions.num_rows // MOTIONS for k in range(MOTIONS)]
        pq.write_table(motions.take(few), folder / "motions.parquet")
        grid(folder / "structures.csv")
        files = ("--in", folder / "motions.parquet", "--structures", folder / "structures.csv", "--out", folder / "out.parquet")
        command = (options.rockfrag, "--quiet", "--threads", 1, "simulate", *files)
        counts, of_place = executed(command, options.rockfrag, folder), operations(options.rockfrag)
        analyses = pq.read_metadata(folder / "out.parquet").num_rows
    total = sum(count * of_place.get(place, 0) for place, count in counts.items())
    print(json.dumps({"analyses": analyses, "flop_an_analysis": total / analyses}))


if __name__ == "__main__":
    main()

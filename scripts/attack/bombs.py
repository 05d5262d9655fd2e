"""Writes small Parquet files that announce what no memory holds: python bombs.py FOLDER (with pyarrow, for its zstd)."""

import struct
import sys
from pathlib import Path

import pyarrow as pa

MOST = 2**31 - 1
BOOL, I32, I64, BINARY, LIST, STRUCT = 1, 5, 6, 8, 9, 12
# Physical types and encodings of Parquet.
INT64, FLOAT, DOUBLE, BYTE_ARRAY = 2, 4, 5, 6
PLAIN, RLE, DELTA_LENGTH, RLE_DICTIONARY = 0, 3, 6, 8
ZSTD = 6


def varint(value):
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(out + bytes([value]))


def integer(value):
    return varint(value << 1 if value >= 0 else (-value << 1) - 1)


def fields(*given):
    """A struct of (number, kind, bytes) in rising order."""
    out, last = b"", 0
    for number, kind, value in given:
        out += bytes([(number - last) << 4 | kind]) + value
        last = number
    return out + b"\0"


def number(at, value, kind=I32):
    return (at, kind, integer(value))


def text(at, value):
    value = value if isinstance(value, bytes) else value.encode()
    return (at, BINARY, varint(len(value)) + value)


def sequence(at, items, kind=STRUCT, count=None):
    count = len(items) if count is None else count
    head = bytes([count << 4 | kind]) if count < 15 else bytes([0xF0 | kind]) + varint(count)
    return (at, LIST, head + b"".join(items))


def leaf(name, physical):
    words = [number(6, 0)] if physical == BYTE_ARRAY else []
    return fields(number(1, physical), number(3, 0), text(4, name), *words)


def group(name, children, repetition=0, converted=None):
    more = [] if converted is None else [number(6, converted)]
    return fields(number(3, repetition), text(4, name), number(5, children), *more)


def page(values, payload, encoding=PLAIN, size=None, statistics=None):
    """A data page of version 1."""
    data = [number(1, values), number(2, encoding), number(3, RLE), number(4, RLE)]
    data += [] if statistics is None else [(5, STRUCT, statistics)]
    head = [number(1, 0), number(2, len(payload) if size is None else size), number(3, len(payload))]
    return fields(*head, (5, STRUCT, fields(*data))) + payload


def dictionary(values, payload, size=None):
    head = [number(1, 2), number(2, len(payload) if size is None else size), number(3, len(payload))]
    return fields(*head, (7, STRUCT, fields(number(1, values), number(2, PLAIN)))) + payload


def run(count, value):
    """A run of one value in the hybrid encoding, values of one byte."""
    return varint(count << 1) + bytes([value])


def levels(count, *values):
    """Levels of a list that goes on and on: the first one, then the rest."""
    first, rest = values
    runs = run(1, first) + (run(count - 1, rest) if count > 1 else b"")
    return struct.pack("<I", len(runs)) + runs


def file(schema, columns, rows, groups=None, footer_length=None, packed=None):
    """columns: (physical type, path, pages, values, whether they begin with a dictionary); `packed` is the path of the column
    that is compressed."""
    out, chunks = b"PAR1", []
    for physical, path, pages, values, has_dictionary in columns:
        start, body = len(out), b"".join(pages)
        offsets = [number(9, start + (len(pages[0]) if has_dictionary else 0), I64)]
        offsets += [number(11, start, I64)] if has_dictionary else []
        meta = fields(
            number(1, physical),
            sequence(2, [integer(PLAIN), integer(RLE), integer(RLE_DICTIONARY)], I32),
            sequence(3, [varint(len(name)) + name.encode() for name in path], BINARY),
            number(4, ZSTD if path == packed else 0), number(5, values, I64), number(6, len(body), I64), number(7, len(body), I64), *offsets,
        )
        chunks.append(fields(number(2, start, I64), (3, STRUCT, meta)))
        out += body
    row_group = fields(sequence(1, chunks), number(2, len(out), I64), number(3, rows, I64))
    row_groups = sequence(4, [row_group] if columns else [], count=groups)
    footer = fields(number(1, 1), sequence(2, schema), number(3, rows, I64), row_groups)
    length = len(footer) if footer_length is None else footer_length
    return out + footer + struct.pack("<I", length) + b"PAR1"


MOTIONS = [
    group("schema", 3), leaf("motion_id", INT64), leaf("dt_s", DOUBLE),
    group("acceleration_m_s2", 1, converted=3), group("list", 1, repetition=2), leaf("element", FLOAT),
]
SAMPLES = ("acceleration_m_s2", "list", "element")


def motions(samples, values, packed=None, dt=0.01, has_dictionary=True):
    """One motion whose samples stand in these pages."""
    plain = lambda form, value: struct.pack(form, value)
    columns = [
        (INT64, ("motion_id",), [page(1, plain("<q", 1))], 1, False),
        (DOUBLE, ("dt_s",), [page(1, plain("<d", dt))], 1, False),
        (FLOAT, SAMPLES, samples, values, has_dictionary),
    ]
    return file(MOTIONS, columns, 1, packed=packed)


def quiet(count, first=0):
    """A page of many equal samples that go on from the page before (first=1) or begin the row."""
    return page(count, levels(count, first, 1) + levels(count, 1, 1) + bytes([1]) + run(count, 0), RLE_DICTIONARY)


ZERO = dictionary(1, struct.pack("<f", 0.0))


def texts(encoding, payload, rows, size=None, first=None, packed=None):
    """A table of one column of texts as motions go by name."""
    schema = [group("schema", 3), leaf("motion_id", BYTE_ARRAY), leaf("dt_s", DOUBLE)] + MOTIONS[3:]
    pages = ([first] if first else []) + [page(rows, payload, encoding, size)]
    columns = [
        (BYTE_ARRAY, ("motion_id",), pages, rows, bool(first)),
        (DOUBLE, ("dt_s",), [dictionary(1, struct.pack("<d", 0.01)), page(rows, bytes([1]) + run(rows, 0), RLE_DICTIONARY)], rows, True),
        (FLOAT, SAMPLES, [ZERO, page(rows, levels(rows, 0, 0) + levels(rows, 1, 1) + bytes([1]) + run(rows, 0), RLE_DICTIONARY)], rows, True),
    ]
    return file(schema, columns, rows, packed=packed)


SCENARIOS = [("scenario_id", INT64, "<q", 1), ("cell", INT64, "<q", 0), ("sample", INT64, "<q", 0)]
SCENARIOS += [(name, DOUBLE, "<d", value) for name, value in
              [("mw", 6.0), ("re_km", 10.0), ("vp_m_s", 1.0), ("tp_s", 1.0), ("gamma", 2.0), ("nu_rad", 0.0)]]


def narrow(rows, names=SCENARIOS):
    """A table, of scenarios or of these columns, whose rows are all the same."""
    in_pages = min(abs(rows), MOST)
    columns = [
        (kind, (name,), [dictionary(1, struct.pack(form, value)), page(in_pages, bytes([1]) + run(in_pages, 0), RLE_DICTIONARY)], rows, True)
        for name, kind, form, value in names
    ]
    return file([group("schema", len(names))] + [leaf(name, kind) for name, kind, _, _ in names], columns, rows)


def bombs():
    plain = page(4, levels(4, 0, 1) + levels(4, 1, 1) + struct.pack("<4f", 0, 1, 2, 0))
    zeros = pa.compress(bytes(300 << 20), codec="zstd", asbytes=True)
    long_text = struct.pack("<I", 1 << 20) + b"x" * (1 << 20)
    packed = pa.compress(long_text, codec="zstd", asbytes=True)
    yield "sound", motions([plain], 4, has_dictionary=False)
    yield "quiet", motions([ZERO, quiet(1000)], 1000)
    yield "largest", motions([ZERO, quiet(2**28)], 2**28)
    yield "long-motion", motions([ZERO, quiet(2**24 + 1)], 2**24 + 1)
    yield "list", motions([ZERO, quiet(MOST)], MOST)
    yield "list-in-pages", motions([ZERO, quiet(2**26)] + [quiet(2**26, 1)] * 200, 201 * 2**26)
    yield "values-in-chunk", motions([plain], 2**62, has_dictionary=False)
    yield "page-size", motions([page(4, b"\0" * 20, size=MOST)], 4, packed=SAMPLES, has_dictionary=False)
    yield "page-size-plain", motions([page(4, b"\0" * 20, size=MOST)], 4, has_dictionary=False)
    yield "page-compressed", motions([page(2**26, zeros, size=300 << 20)], 2**26, packed=SAMPLES, has_dictionary=False)
    yield "page-negative", motions([page(-4, b"\0" * 20, size=-1)], -4, has_dictionary=False)
    yield "dictionary", motions([dictionary(MOST, b"\0" * 4), quiet(8)], 8)
    huge = fields((1, BINARY, varint(2**40) + b"x"))
    yield "statistics", motions([page(4, b"\0" * 20, statistics=huge)], 4, has_dictionary=False)
    yield "step-tiny", motions([plain], 4, dt=1e-300, has_dictionary=False)
    yield "step-huge", motions([plain], 4, dt=1e300, has_dictionary=False)
    yield "row-groups", file([group("schema", 0)], [], 1, groups=MOST)
    # The version says that it is a number of another kind, which is longer; the decoder reads on as if it were not.
    yield "kinds", file([group("schema", 0)], [], 1, groups=MOST).replace(b"PAR1\x15", b"PAR1\x17", 1)
    yield "children", file([group("schema", MOST)], [], 1)
    yield "nested", file([group("g", 1)] * 5000 + [leaf("x", INT64)], [], 1)
    yield "footer", file([group("schema", 0)], [], 1, footer_length=2**32 - 1)
    yield "rows", narrow(2**40)
    yield "rows-in-page", narrow(MOST)
    yield "rows-of-motions", narrow(2**27, [("motion_id", INT64, "<q", 1)])
    yield "rows-of-peaks", narrow(2**27, [("pga_m_s2", DOUBLE, "<d", 5.0), ("pgv_m_s", DOUBLE, "<d", 0.5)])
    yield "rows-negative", narrow(-5)
    yield "texts-by-difference", texts(DELTA_LENGTH, b"\x80\x01\x04" + varint(2**60) + b"\0" * 8, 4)
    # A text of a megabyte in each row, of no more rows than the file has bytes: pages compressed one by one.
    which = bytes([1]) + run(256, 0)
    yield "long-texts", texts(RLE_DICTIONARY, pa.compress(which, codec="zstd", asbytes=True), 256, len(which),
                              dictionary(1, packed, size=len(long_text)), ("motion_id",))


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in bombs():
        (folder / f"{name}.parquet").write_bytes(content)

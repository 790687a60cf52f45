# SPDX-License-Identifier: Apache-2.0
"""Reads a pixel of an EXR file with rows of 32-bit or 16-bit floating-point numbers, uncompressed or by ZIP (one or sixteen rows)."""
import struct
import zlib

SIZES = {1: ("e", 2), 2: ("f", 4)}


def header(data):
    """Attributes by their names, and where the table of offsets begins."""
    place, found = 8, {}
    while data[place]:
        end = data.index(0, place)
        name = data[place:end].decode()
        kind_end = data.index(0, end + 1)
        size, = struct.unpack_from("<i", data, kind_end + 1)
        found[name] = data[kind_end + 5:kind_end + 5 + size]
        place = kind_end + 5 + size
    return found, place + 1


def channels(packed):
    place, result = 0, []
    while packed[place]:
        end = packed.index(0, place)
        result.append((packed[place:end].decode(), SIZES[struct.unpack_from("<i", packed, end + 1)[0]]))
        place = end + 17
    return result


def unpacked(packed, size):
    if len(packed) == size:
        return packed
    raw = bytearray(zlib.decompress(packed))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    half = (len(raw) + 1) // 2
    result = bytearray(len(raw))
    result[0::2], result[1::2] = raw[:half], raw[half:]
    return bytes(result)


def pixel(path, column, row):
    data = open(path, "rb").read()
    found, place = header(data)
    left, top, right, bottom = struct.unpack("<4i", found["dataWindow"])
    rows = {0: 1, 2: 1, 3: 16}.get(found["compression"][0])
    if data[:4] != b"v/1\x01" or rows is None or not (left <= column <= right and top <= row <= bottom):
        raise ValueError(f"{path}: not a picture that this can read, or without that pixel")
    width, wanted = right - left + 1, channels(found["channels"])
    line = width * sum(size for _, (_, size) in wanted)
    block = (row - top) // rows
    offset, = struct.unpack_from("<Q", data, place + 8 * block)
    first, size = struct.unpack_from("<ii", data, offset)
    count = min(rows, bottom - first + 1)
    raw = unpacked(data[offset + 8:offset + 8 + size], count * line)
    at, result = (row - first) * line, {}
    for name, (code, bytes_each) in wanted:
        result[name], = struct.unpack_from("<" + code, raw, at + (column - left) * bytes_each)
        at += width * bytes_each
    return [result[name] for name in "RGB"]

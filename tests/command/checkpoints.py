"""Checkpoint files as tests change them: their seal is 512 bytes of text before the HDF5 file."""

import os

import h5py

SEAL = 512
POLYNOMIAL = 0xC96C5795D7870F42  # CRC-64/XZ, reflected


def _table():
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte >> 1) ^ (POLYNOMIAL if byte & 1 else 0)
        table.append(byte)
    return table


TABLE = _table()


def crc64(data):
    value = 0xFFFFFFFFFFFFFFFF
    for byte in data:
        value = TABLE[(value ^ byte) & 0xFF] ^ (value >> 8)
    return value ^ 0xFFFFFFFFFFFFFFFF


def serial(file):
    with open(file, "rb") as checkpoint:
        return int(checkpoint.read(SEAL).split(b"\n")[1].split()[1])


def newest(folder):
    """(newest, older) of the two checkpoints of a run."""
    a, b = (os.path.join(folder, name) for name in ("checkpoint_a.h5", "checkpoint_b.h5"))
    return (a, b) if serial(a) > serial(b) else (b, a)


def change(file, edit):
    """Lets edit(h5py.File) change what a checkpoint holds, and seals it again."""
    number = serial(file)
    with open(file, "rb") as checkpoint:
        content = checkpoint.read()[SEAL:]
    inner = file + ".inner"
    with open(inner, "wb") as temporary:
        temporary.write(content)
    with h5py.File(inner, "r+") as opened:
        edit(opened)
    with open(inner, "rb") as temporary:
        content = temporary.read()
    os.remove(inner)
    seal = f"Mesogen checkpoint 1\nserial {number}\nlength {SEAL + len(content)}\ncrc64 {crc64(content):016x}\n"
    with open(file, "wb") as checkpoint:
        checkpoint.write(seal.encode().ljust(SEAL, b"\0") + content)

"""Reads an extended XYZ file by the rules of its description alone and compares it with the CSV of the same packing.

usage: xyz_reader.py IN.xyz IN.csv
"""
import re
import shlex
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    count, comment, *lines = file.read().splitlines()
keys = dict(word.split("=", 1) for word in shlex.split(comment))
fields = re.findall(r"(\w+):([SIRL]):(\d+)", keys["Properties"])
assert fields == [("species", "S", "1"), ("pos", "R", "3"), ("radius", "R", "1")], fields
assert len(keys["Lattice"].split()) == 9 and set(keys["pbc"].split()) <= {"T", "F"}
with open(sys.argv[2], encoding="utf-8") as file:
    rows = [[float(x) for x in line.split(",")] for line in file if line[0] not in "#x"]
assert int(count) == len(lines) == len(rows) > 0
for line, row in zip(lines, rows):
    assert [float(x) for x in line.split()[1:]] == row, line

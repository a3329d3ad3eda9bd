"""Reads a VTP file with VTK, compares it with the CSV of the same packing, and writes it anew in base64.

usage: vtk_reader.py IN.vtp IN.csv OUT.vtp      exit code 77: VTK is not installed
"""
import sys

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
except ImportError:
    sys.exit(77)

vtp, csv, out = sys.argv[1:]
reader = vtkXMLPolyDataReader()
reader.SetFileName(vtp)
reader.Update()
data = reader.GetOutput()
radius = data.GetPointData().GetArray("radius")
with open(csv, encoding="utf-8") as file:
    rows = [[float(x) for x in line.split(",")] for line in file if line[0] not in "#x"]
assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == len(rows) > 0, data.GetNumberOfPoints()
for i, row in enumerate(rows):
    assert [*data.GetPoint(i), radius.GetValue(i)] == row, (i, row)
assert data.GetFieldData().GetAbstractArray("unit").GetValue(0) == "um"
writer = vtkXMLPolyDataWriter()
writer.SetFileName(out)
writer.SetInputData(data)
writer.SetDataModeToAppended()
writer.EncodeAppendedDataOn()
writer.SetCompressorTypeToNone()
assert writer.Write() == 1

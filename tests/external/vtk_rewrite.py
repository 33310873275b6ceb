"""Reads a .vtp with VTK, checks its arrays against the file's own text, and writes it anew: what VTK read, we read again."""
import base64
import re
import struct
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

source, target, mode = sys.argv[1:]
reader = vtkXMLPolyDataReader()
reader.SetFileName(source)
reader.Update()
data = reader.GetOutput()
text = open(source).read()


def stored(name, code):
    found = re.search(r'Name="%s"[^>]*>\s*(\S+)\s*</DataArray>' % name, text)
    block = base64.b64decode(found.group(1))
    count = struct.unpack("<I", block[:4])[0] // struct.calcsize(code)
    return list(struct.unpack("<%d%s" % (count, code), block[4:]))


radius = data.GetPointData().GetArray("MaximumInscribedSphereRadius")
assert [radius.GetValue(i) for i in range(radius.GetNumberOfValues())] == stored("MaximumInscribedSphereRadius", "d")
points = data.GetPoints().GetData()
assert [points.GetValue(i) for i in range(points.GetNumberOfValues())] == stored("Points", "d")
for name in ("CenterlineIds", "TractIds", "GroupIds", "Blanking", "VesselIds", "VesselKinds"):
    array = data.GetCellData().GetArray(name)
    assert [array.GetValue(i) for i in range(array.GetNumberOfValues())] == stored(name, "i"), name
names = data.GetFieldData().GetAbstractArray("VesselNames")
assert names.GetNumberOfValues() == data.GetNumberOfLines()

writer = vtkXMLPolyDataWriter()
writer.SetFileName(target)
writer.SetInputData(data)
if mode == "binary":
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
elif mode == "appended":
    writer.SetDataModeToAppended()
    writer.SetEncodeAppendedData(0)
    writer.SetCompressorTypeToZLib()
else:
    writer.SetDataModeToAppended()
    writer.SetEncodeAppendedData(1)
    writer.SetCompressorTypeToZLib()
writer.Write()
print("lines", data.GetNumberOfLines(), "points", data.GetNumberOfPoints(), "- first vessel:", names.GetValue(0))

"""What is in a .dream3d file, as h5py reads it."""
import json
import sys

import h5py

arrays = {}
h5py.File(sys.argv[1]).visititems(lambda name, thing: arrays.update({name.rsplit("/", 1)[1]: thing[()]}) if isinstance(thing, h5py.Dataset) else None)
points = arrays["SharedVertexList"]
labels = arrays["FaceLabels"]
names = [str(text) for name, array in arrays.items() if "Name" in name for text in array.ravel().tolist()]
print("FOUND " + json.dumps({"extent": (points.max(axis=0) - points.min(axis=0)).tolist(), "faces": len(arrays["SharedTriList"]),
                             "regions": len(set(labels.ravel().tolist()) & {1, 2}), "names": names}))

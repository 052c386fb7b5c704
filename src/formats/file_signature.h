// Formats that the first bytes of a file tell, whatever its name.
#pragma once

#include "formats/input_file.h"

namespace regionmesh::formats {

/// The extension of the format, such as ".h5" for a .mat file of MATLAB 7.3; null where the bytes tell none.
const char* extension_by_content(const InputFile& file);

}  // namespace regionmesh::formats

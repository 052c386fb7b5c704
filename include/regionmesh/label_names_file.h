// Tables that say what labels are called.
#pragma once

#include <filesystem>

#include "regionmesh/label_names.h"

namespace regionmesh {

/// Reads a table of labels and names, as many programs write one:
///   CSV, TSV or ';'   with or without a header, columns in any order: `label,name`, `index<tab>name<tab>colour`
///   index name ...    AAL, FreeSurfer and 3D Slicer colour tables: numbers behind the names (a code, colours) are
///   dropped ITK-SNAP          idx r g b a vis mesh "name" XML atlas         <label index="0">name</label> (FSL),
///   <label><index>1</index><name>name</name></label> (SPM, AAL3)
/// Blank lines and lines that begin with #, % or // are passed over, and so are rows whose name is empty. Where a
/// header does not say it, the labels are the first column of whole numbers, the names the first of anything but
/// numbers. Text that is no UTF-8 is taken as Latin-1. Throws Error(kInput) naming file and line: no table, a label
/// that is no whole number, two names for one label, or no names at all.
LabelNames read_label_names(const std::filesystem::path& path);

namespace formats {

/// The names in a table beside a volume: for atlas.nii.gz atlas.nii.txt, atlas.txt, and with .xml, .tsv, .csv, .label
/// or .ctbl likewise, in this order. A file that is no such table may stand there for another purpose: it is passed
/// over.
LabelNames names_beside(const std::filesystem::path& volume);

}  // namespace formats
}  // namespace regionmesh

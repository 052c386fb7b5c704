// Tables with the names of labels.
#pragma once

#include <filesystem>

#include "regionmesh/label_names.h"

namespace regionmesh {

/// Reads a table of labels and names in any of these forms:
///   CSV, TSV or ';'   with or without a header, columns in any order: `label,name`, `index<tab>name<tab>colour`
///   index name ...    AAL, FreeSurfer and 3D Slicer colour tables; trailing numbers (codes, colours) are dropped
///   ITK-SNAP          idx r g b a vis mesh "name"
///   XML atlas         <label index="0">name</label> (FSL), or
///                     <label><index>1</index><name>name</name></label> (SPM, AAL3)
/// Ignores blank lines, lines that begin with #, % or //, and rows with an empty name. Without a header, the labels are
/// the first column of whole numbers and the names the first column that has other text. Text that is no UTF-8 is read
/// as Latin-1. Throws Error(kInput) naming file and row: no table, a label that is no whole number, two names for one
/// label, or no names.
LabelNames read_label_names(const std::filesystem::path& path);

namespace formats {

/// The names from a table beside a volume: for atlas.nii.gz atlas.nii.txt or atlas.txt, then likewise .xml, .tsv, .csv,
/// .label and .ctbl. Ignores files of these names that are no tables of labels.
LabelNames names_beside(const std::filesystem::path& volume);

}  // namespace formats
}  // namespace regionmesh

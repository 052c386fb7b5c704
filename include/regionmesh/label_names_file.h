// Tables with the names and the colours of labels.
#pragma once

#include <filesystem>
#include <string>

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

/// Reads the colours in such a table:
///   with a header     a column color, colour, hex or rgb (#RRGGBB, as in BIDS), or columns r, g, b (0 to 255; 3D
///                     Slicer's Color_R, Color_G, Color_B)
///   ITK-SNAP          idx r g b a vis mesh "name"
///   label name r g b a   FreeSurfer and 3D Slicer; only if every row has four numbers from 0 to 255 at its end
/// A row without a label or without a whole colour has none; of two rows with one label the first one counts. Throws
/// Error(kInput) where the file cannot be read, never because of its contents.
LabelColours read_label_colours(const std::filesystem::path& path);

namespace formats {

struct NamesAndColours {
    LabelNames names = {};
    LabelColours colours = {};
    std::string warning = {};  // warning of a table with a row that cannot be read, as in VolumeInfo
};

/// From a table beside a volume: for atlas.nii.gz atlas.nii.txt or atlas.txt, then likewise .xml, .tsv, .csv, .label
/// and .ctbl. Ignores files of these names that are no tables of labels: half of the lines of a table begin with one.
NamesAndColours table_beside(const std::filesystem::path& volume);

}  // namespace formats
}  // namespace regionmesh

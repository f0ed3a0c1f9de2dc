// A file driver for HDF5 that adds to a file all or nothing, so that neither a killed run nor a full disk costs what was written before.
//
// HDF5 changes its tables in place, several blocks for one new frame, and writes them in order of their addresses. A run killed in between leaves tables
// that refer to blocks never written: 54 of 598 such moments made earlier frames unreadable. Here blocks beyond the old end of the file are written at
// once, changes below it are held back until the flush and then made in an order of which every beginning is a whole file as far as older data go:
// the superblock (with the new end), plain blocks and heaps, tree nodes from the root down, symbol tables.
// If anything fails before that point, the file is as it was. A failure is reported by H5Fflush and by nothing else, so a flush must precede the closing.
#pragma once
#include <hdf5.h>

namespace nanson::hdf5 {

/// Makes files that are opened with this access list go through the driver. What is written is an ordinary HDF5 file.
void use_staged_driver(hid_t file_access);

}  // namespace nanson::hdf5

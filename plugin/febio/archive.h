/// Storage of values of the core in FEBio's dump streams, for restart files and repeated time steps.
#pragma once

#include "contact/base/types.h"

#include <FECore/DumpStream.h>

#include <vector>

/// Writes a value to an archive or reads it, depending on the archive's mode.
template <class T>
void archive(DumpStream& ar, T& value) {
  ar & value;
}

/// Writes a vector to an archive or reads it. The vector is cleared before reading, because FEBio does not change it if
/// the stored one is empty.
template <class T>
void archive(DumpStream& ar, std::vector<T>& values) {
  if (!ar.IsSaving()) values.clear();
  ar & values;
}

/// Writes an Eigen matrix or vector to an archive or reads it: its shape, then its entries.
template <int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
void archive(DumpStream& ar, Eigen::Matrix<double, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
  int rows = static_cast<int>(matrix.rows());
  int columns = static_cast<int>(matrix.cols());
  std::vector<double> entries(matrix.data(), matrix.data() + matrix.size());
  ar & rows & columns;
  archive(ar, entries);
  if (ar.IsSaving()) return;
  matrix = Eigen::Map<const Eigen::Matrix<double, Rows, Columns, Options, MaxRows, MaxColumns>>(entries.data(), rows,
                                                                                                columns);
}

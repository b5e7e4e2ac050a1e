/// Values that a model gives per solute: <tag sol="name or id">value</tag>.
#pragma once

#include <string>
#include <vector>

/// The value of one solute, as a model gives it.
struct SoluteValue {
  int solute = 0;  ///< id in the model file, from 1; 0 if absent, for the only solute of a model
  double value = 0;

  /// Index of the solute, from 0.
  int index() const { return solute > 0 ? solute - 1 : 0; }
};

/// The first fault of the values of a tag, as a sentence; empty if there is none. `solutes`: how many the
/// model has. `most`: the largest value that is allowed; the least is 0.
std::string complaint(const std::string& tag, const std::vector<SoluteValue>& values, int solutes, double most);

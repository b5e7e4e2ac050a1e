/// Parameters with one value per solute: <tag sol="name or id">value</tag>.
#pragma once

#include <string>
#include <vector>

/// The value for one solute.
struct SoluteValue {
  int solute = 0;  ///< id in the model file, from 1; 0 if it is not given, for the only solute of a model
  double value = 0;

  /// Index of the solute, from 0.
  int index() const { return solute > 0 ? solute - 1 : 0; }
};

/// The first fault of the values of a parameter, as a sentence; empty if there is none. `solutes`: number of solutes in
/// the model. `most`: largest allowed value; the smallest is 0.
std::string complaint(const std::string& tag, const std::vector<SoluteValue>& values, int solutes, double most);

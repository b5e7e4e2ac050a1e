#include "devices.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace newton {
namespace {

std::string trimmed(const std::string& text) {
  const char* const blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Adds the devices that a word denotes to a set. Returns false if the word denotes nothing.
bool add(const std::string& word, DeviceSet& set) {
  if (word == "all") {
    set.set();
    return true;
  }
  const auto* const found = std::find(device_names.begin(), device_names.end(), word);
  if (found != device_names.end()) set.set(static_cast<std::size_t>(found - device_names.begin()));
  return found != device_names.end() || word == "none";
}

void append(std::string& list, const std::string& part) { list += (list.empty() ? "" : ", ") + part; }

}  // namespace

NamedDevices named_devices(const std::string& list) {
  NamedDevices found;
  std::istringstream rest(list);
  for (std::string each; std::getline(rest, each, ',');) {
    const std::string word = trimmed(each);
    if (!add(word, found.set)) found.unknown.push_back(word);
  }
  return found;
}

std::string allowed_devices() {
  return R"("all", "none", or some of the names )" + names(DeviceSet().set()) + " with commas between them";
}

std::string names(const DeviceSet& set) {
  std::string list;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i]) append(list, indexing::at(device_names, i));
  }
  return list.empty() ? "none" : list;
}

bool DeviceRecord::suspend() {
  is_suspended_ = true;
  return !std::exchange(has_been_suspended_, true);
}

std::string DeviceRecord::summary() const {
  std::string list;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const int count = indexing::at(counts_, i);
    if (count > 0) append(list, indexing::at(device_names, i) + (" " + std::to_string(count)));
  }
  return list.empty() ? list : "Number of actions of each solver device: " + list + ".";
}

}  // namespace newton

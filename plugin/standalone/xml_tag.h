/// Tags of an XML file, read strictly: whatever is missing, malformed or unknown is an InputError that names tag and
/// line.
#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace standalone {

/// A tag of a document that outlives it.
class Tag {
 public:
  Tag(const tinyxml2::XMLElement& element, const std::string& file) : element_(&element), file_(&file) {}

  std::string name() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }
  /// Throws the InputError "file, line 12, <tag>: what".
  [[noreturn]] void fail(const std::string& what) const;

  std::optional<std::string> find_attribute(const char* name) const;
  std::string attribute(const char* name) const;
  /// Fails if there is an attribute other than these.
  void allow_attributes(std::initializer_list<const char*> names) const;
  /// Fails if there is a child other than these.
  void allow_children(std::initializer_list<const char*> names) const;

  std::vector<Tag> children() const;
  std::vector<Tag> children(const char* name) const;
  /// The only child of a name; empty if there is none, a failure if there are several.
  std::optional<Tag> find(const char* name) const;
  Tag child(const char* name) const;

  std::string text() const;
  double number() const;
  int integer(int least, int most) const;
  bool flag() const;
  /// Numbers separated by commas or blanks; a failure if they are not `count`.
  std::vector<double> numbers(std::size_t count) const;
  /// Positive integers separated by commas or blanks.
  std::vector<int> integers() const;

  /// The attribute as a positive integer.
  int integer_attribute(const char* name) const;

 private:
  double to_number(const std::string& word) const;
  int to_integer(const std::string& word, int least, int most) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

/// A parsed XML file.
class XmlFile {
 public:
  /// Reads a file; throws InputError where it is missing, too large or no XML.
  explicit XmlFile(const std::string& path);
  Tag root() const;

 private:
  std::string path_;
  tinyxml2::XMLDocument document_;
};

/// Names in quotes with commas between, to say what is allowed.
template <class Names>
std::string listed(const Names& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return list.empty() ? "nothing" : list;
}

}  // namespace standalone

/// Strict reading of XML tags: a missing, malformed or unread tag causes an InputError with tag and line.
#pragma once

#include <tinyxml2.h>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace standalone {

using Names = std::vector<const char*>;

/// A range of allowed numbers, with its description for messages.
struct Range {
  bool (*holds)(double);
  const char* words;
};
inline constexpr Range any{[](double) { return true; }, "a number"};
inline constexpr Range positive{[](double x) { return x > 0; }, "positive"};
inline constexpr Range not_negative{[](double x) { return x >= 0; }, "zero or a positive number"};

/// The names of tags and attributes that a reader has requested; the file may contain no others.
struct Asked {
  struct OfTag {
    std::set<std::string> children;
    std::set<std::string> attributes;
    bool everything = false;
  };
  std::map<const tinyxml2::XMLElement*, OfTag> tags;
};

/// A tag of an XML document, which has to outlive it. Its functions record the requested names.
class Tag {
 public:
  Tag(const tinyxml2::XMLElement& element, const std::string& file, Asked& asked)
      : element_(&element), file_(&file), asked_(&asked) {}

  std::string name() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }
  /// Throws InputError with the text "file, line 12, <tag>: what".
  [[noreturn]] void fail(const std::string& what) const;
  /// Fails if this tag, or a tag in it, contains a tag or attribute that was not requested. Every tag may have a name.
  void check() const;

  /// All children with this name.
  std::vector<Tag> all(const std::string& name) const;
  /// The child with this name; empty if there is none.
  std::optional<Tag> find(const std::string& name) const;
  /// The child with this name; fails unless there is exactly one.
  Tag one(const std::string& name) const;
  /// Permits children with these names without reading them.
  void ignore(const Names& names) const;

  std::optional<std::string> find_attribute(const char* name) const;
  std::string attribute(const char* name) const;
  /// The attribute as a positive integer; fails for other values.
  int integer_attribute(const char* name) const;
  /// The attribute; fails unless it is one of the allowed words.
  std::string attribute(const char* name, const Names& allowed) const;

  std::string text() const;
  double number(const Range& range = any) const;
  int integer(int least = std::numeric_limits<int>::min(), int most = std::numeric_limits<int>::max()) const;
  bool flag() const { return integer(0, 1) == 1; }
  /// The index of the text among these words, from 0; fails for other texts.
  std::size_t one_of(const Names& words) const;
  /// The numbers in the text, separated by commas or blanks; fails unless there are `count` of them.
  std::vector<double> numbers(std::size_t count) const;
  /// The positive integers in the text, separated by commas or blanks.
  std::vector<int> integers() const;

  /// Sets `value` to the number in a child, if there is such a child.
  void take(const char* name, double& value, const Range& range) const;
  void take(const char* name, int& value, int least, int most = std::numeric_limits<int>::max()) const;
  /// Fails if there is such a child and its text is none of these words.
  void must_be(const char* name, const Names& words) const;

 private:
  double to_number(const std::string& word) const;
  int to_integer(const std::string& word, int least, int most = std::numeric_limits<int>::max()) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
  Asked* asked_;
};

/// Calls `read` with the root tag of a file, then fails if the file contains tags that were not requested. Throws
/// InputError if the file is missing, too large or not XML.
void read_xml(const std::string& path, const std::function<void(const Tag&)>& read);

/// The names in quotes, separated by commas; "nothing" for an empty list.
template <class List>
std::string listed(const List& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return list.empty() ? "nothing" : list;
}

}  // namespace standalone

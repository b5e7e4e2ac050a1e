/// Tags of an XML file, read strictly: a missing, malformed or unread tag is an InputError that names tag
/// and line.
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

/// The allowed numbers, with words for a message.
struct Range {
  bool (*holds)(double);
  const char* words;
};
inline constexpr Range any{[](double) { return true; }, "a number"};
inline constexpr Range positive{[](double x) { return x > 0; }, "positive"};
inline constexpr Range not_negative{[](double x) { return x >= 0; }, "zero or a positive number"};

/// The tags that a reader has read: all that a file may hold.
struct Asked {
  struct OfTag {
    std::set<std::string> children;
    std::set<std::string> attributes;
    bool everything = false;
  };
  std::map<const tinyxml2::XMLElement*, OfTag> tags;
};

/// A tag of a document that outlives it. A reader's calls note the names that they ask about.
class Tag {
 public:
  Tag(const tinyxml2::XMLElement& element, const std::string& file, Asked& asked)
      : element_(&element), file_(&file), asked_(&asked) {}

  std::string name() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }
  /// Throws the InputError "file, line 12, <tag>: text".
  [[noreturn]] void fail(const std::string& what) const;
  /// Fails where this tag or one in it holds a tag that was not read. Any tag may have a name.
  void check() const;

  /// The children of a name; the one child, if there is one; and the one child that must be there.
  std::vector<Tag> all(const std::string& name) const;
  std::optional<Tag> find(const std::string& name) const;
  Tag one(const std::string& name) const;
  /// Children that mean nothing here, whatever they hold.
  void ignore(const Names& names) const;

  std::optional<std::string> find_attribute(const char* name) const;
  std::string attribute(const char* name) const;
  /// The attribute as a positive integer.
  int integer_attribute(const char* name) const;
  /// The attribute, which must be one of these.
  std::string attribute(const char* name, const Names& allowed) const;

  std::string text() const;
  double number(const Range& range = any) const;
  int integer(int least = std::numeric_limits<int>::min(), int most = std::numeric_limits<int>::max()) const;
  bool flag() const { return integer(0, 1) == 1; }
  /// The position of the text among these words, from 0; an error for any other text.
  std::size_t one_of(const Names& words) const;
  /// Numbers separated by commas or blanks; a failure if they are not `count`.
  std::vector<double> numbers(std::size_t count) const;
  /// Positive integers separated by commas or blanks.
  std::vector<int> integers() const;

  /// Takes the number of a child, if there is one.
  void take(const char* name, double& value, const Range& range) const;
  void take(const char* name, int& value, int least, int most = std::numeric_limits<int>::max()) const;
  /// Checks that a child, if there is one, contains one of these words.
  void must_be(const char* name, const Names& words) const;

 private:
  double to_number(const std::string& word) const;
  int to_integer(const std::string& word, int least, int most = std::numeric_limits<int>::max()) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
  Asked* asked_;
};

/// Calls `read` with the root tag of a file, which then must hold no other tags; throws InputError where
/// the file is missing, too large or no XML.
void read_xml(const std::string& path, const std::function<void(const Tag&)>& read);

/// Names in quotes with commas between, for lists of allowed names.
template <class List>
std::string listed(const List& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return list.empty() ? "nothing" : list;
}

}  // namespace standalone

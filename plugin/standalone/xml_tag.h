/// Tags of an XML file, read strictly and by tables: whatever is missing, malformed or unknown is an InputError that
/// names tag and line.
#pragma once

#include <tinyxml2.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace standalone {

class Tag;
using Read = std::function<void(const Tag&)>;
using Names = std::vector<const char*>;

/// A child tag: how often it may stand there, and what takes it.
struct Child {
  std::string name;
  Read read;
  std::size_t least, most;
};
inline Child one(std::string name, Read read) { return {std::move(name), std::move(read), 1, 1}; }
inline Child maybe(std::string name, Read read) { return {std::move(name), std::move(read), 0, 1}; }
inline Child each(std::string name, Read read) {
  return {std::move(name), std::move(read), 0, std::numeric_limits<std::size_t>::max()};
}

/// Which numbers are allowed, in words for a message.
struct Range {
  bool (*holds)(double);
  const char* words;
};
inline constexpr Range any{[](double) { return true; }, "a number"};
inline constexpr Range positive{[](double x) { return x > 0; }, "positive"};
inline constexpr Range not_negative{[](double x) { return x >= 0; }, "a number that is not negative"};

/// A tag of a document that outlives it.
class Tag {
 public:
  Tag(const tinyxml2::XMLElement& element, const std::string& file) : element_(&element), file_(&file) {}

  std::string name() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }
  /// Throws the InputError "file, line 12, <tag>: what".
  [[noreturn]] void fail(const std::string& what) const;

  /// Hands the children to the table, in the order of the table; no other attributes and children may be there.
  void read(const Names& attributes, const std::vector<Child>& table = {}) const;

  std::optional<std::string> find_attribute(const char* name) const;
  std::string attribute(const char* name) const;
  /// The attribute as a positive integer.
  int integer_attribute(const char* name) const;
  /// The attribute, which must be one of these.
  std::string attribute(const char* name, const Names& allowed) const;

  std::string text() const;
  double number(const Range& range = any) const;
  int integer(int least, int most = std::numeric_limits<int>::max()) const;
  bool flag() const { return integer(0, 1) == 1; }
  /// Which of these words the text is, from 0.
  std::size_t one_of(const Names& words) const;
  /// Numbers separated by commas or blanks; a failure if they are not `count`.
  std::vector<double> numbers(std::size_t count) const;
  /// Positive integers separated by commas or blanks.
  std::vector<int> integers() const;

 private:
  std::vector<Tag> children() const;
  double to_number(const std::string& word) const;
  int to_integer(const std::string& word, int least, int most = std::numeric_limits<int>::max()) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

/// Calls `read` with the root tag of a file; throws InputError where the file is missing, too large or no XML.
void read_xml(const std::string& path, const Read& read);

// What takes a tag without attributes and children: into a variable, ...
Read into(double& value, const Range& range = any);
Read into(int& value, int least = std::numeric_limits<int>::min(), int most = std::numeric_limits<int>::max());
Read into(bool& value);
Read into(std::string& value);
/// ... or only to see that it says one of these words, or a number in this range.
Read must_be(const Names& words);
Read must_be(const Range& range);

/// Names in quotes with commas between, to say what is allowed.
template <class List>
std::string listed(const List& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return list.empty() ? "nothing" : list;
}

}  // namespace standalone

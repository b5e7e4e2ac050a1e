#include "xml_tag.h"

#include "error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

namespace standalone {
namespace {

constexpr const char* blank = " \t\r\n";
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30U;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(blank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Words between commas and blanks.
std::vector<std::string> words(const std::string& text) {
  constexpr const char* separators = ", \t\r\n";
  std::vector<std::string> list;
  for (std::size_t start = text.find_first_not_of(separators); start != std::string::npos;) {
    const std::size_t end = text.find_first_of(separators, start);
    list.push_back(text.substr(start, end - start));
    start = end == std::string::npos ? end : text.find_first_not_of(separators, end);
  }
  return list;
}

template <class T>
bool parse(const std::string& word, T& value) {
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool contains(std::initializer_list<const char*> names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void Tag::fail(const std::string& what) const {
  throw InputError(*file_ + ", line " + std::to_string(line()) + ", <" + name() + ">: " + what);
}

std::optional<std::string> Tag::find_attribute(const char* name) const {
  const char* value = element_->Attribute(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

std::string Tag::attribute(const char* name) const {
  const auto value = find_attribute(name);
  if (!value) fail("the attribute " + std::string(name) + " is missing");
  return *value;
}

void Tag::allow_attributes(std::initializer_list<const char*> names) const {
  for (const auto* a = element_->FirstAttribute(); a != nullptr; a = a->Next()) {
    if (!contains(names, a->Name()))
      fail("the attribute \"" + std::string(a->Name()) + "\" is not supported; allowed: " + listed(names));
  }
}

void Tag::allow_children(std::initializer_list<const char*> names) const {
  for (const Tag& tag : children()) {
    if (!contains(names, tag.name())) tag.fail("not supported here; in <" + name() + "> there may be " + listed(names));
  }
}

std::vector<Tag> Tag::children() const {
  std::vector<Tag> list;
  for (const auto* e = element_->FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    list.emplace_back(*e, *file_);
  return list;
}

std::vector<Tag> Tag::children(const char* name) const {
  std::vector<Tag> list;
  for (const auto* e = element_->FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) {
    list.emplace_back(*e, *file_);
  }
  return list;
}

std::optional<Tag> Tag::find(const char* name) const {
  const std::vector<Tag> all = children(name);
  if (all.size() > 1) all[1].fail("there may be only one in <" + this->name() + ">");
  return all.empty() ? std::nullopt : std::optional<Tag>(all.front());
}

Tag Tag::child(const char* name) const {
  const auto tag = find(name);
  if (!tag) fail("the tag <" + std::string(name) + "> is missing");
  return *tag;
}

std::string Tag::text() const {
  const char* text = element_->GetText();
  return text ? trimmed(text) : std::string();
}

double Tag::to_number(const std::string& word) const {
  double value = 0;
  if (!parse(word, value) || !std::isfinite(value)) fail("\"" + word.substr(0, 40) + "\" is not a finite number");
  return value;
}

int Tag::to_integer(const std::string& word, int least, int most) const {
  int value = 0;
  if (!parse(word, value) || value < least || value > most) {
    fail("\"" + word.substr(0, 40) + "\" is not an integer from " + std::to_string(least) + " to " +
         std::to_string(most));
  }
  return value;
}

double Tag::number() const { return to_number(text()); }

int Tag::integer(int least, int most) const { return to_integer(text(), least, most); }

bool Tag::flag() const { return integer(0, 1) == 1; }

std::vector<double> Tag::numbers(std::size_t count) const {
  const std::vector<std::string> list = words(text());
  if (list.size() != count)
    fail("expected " + std::to_string(count) + " numbers, found " + std::to_string(list.size()));
  std::vector<double> values;
  for (const std::string& word : list) values.push_back(to_number(word));
  return values;
}

std::vector<int> Tag::integers() const {
  std::vector<int> values;
  for (const std::string& word : words(text())) values.push_back(to_integer(word, 1, std::numeric_limits<int>::max()));
  return values;
}

int Tag::integer_attribute(const char* name) const {
  return to_integer(trimmed(attribute(name)), 1, std::numeric_limits<int>::max());
}

XmlFile::XmlFile(const std::string& path) : path_(path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError("the model file " + path + " cannot be read: " + error.message());
  if (size > largest_file) throw InputError("the model file " + path + " is larger than 1 GiB");
  if (document_.LoadFile(path.c_str()) == tinyxml2::XML_SUCCESS && document_.RootElement() != nullptr) return;
  throw InputError(path + ", line " + std::to_string(document_.ErrorLineNum()) + ": no valid XML (" +
                   document_.ErrorName() + ")");
}

Tag XmlFile::root() const { return {*document_.RootElement(), path_}; }

}  // namespace standalone

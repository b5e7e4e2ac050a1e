#include "xml_tag.h"

#include "error.h"
#include "indexing/entries.h"

#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace standalone {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30U;

/// The words of a text, separated by commas or blanks.
std::vector<std::string> words(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

void Tag::fail(const std::string& what) const {
  throw InputError(*file_ + ", line " + std::to_string(line()) + ", <" + name() + ">: " + what);
}

void Tag::check() const {
  const Asked::OfTag& asked = asked_->tags[element_];
  if (asked.everything) return;
  for (const auto* a = element_->FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string attribute = a->Name();
    if (attribute != "name" && asked.attributes.count(attribute) == 0)
      fail("the attribute \"" + attribute + "\" is not supported; allowed: " + listed(asked.attributes));
  }
  for (const auto* e = element_->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const Tag child(*e, *file_, *asked_);
    if (asked.children.count(child.name()) == 0)
      child.fail("not supported here; in <" + name() + "> there may be " + listed(asked.children));
    child.check();
  }
}

std::vector<Tag> Tag::all(const std::string& name) const {
  asked_->tags[element_].children.insert(name);
  std::vector<Tag> list;
  for (const auto* e = element_->FirstChildElement(name.c_str()); e != nullptr; e = e->NextSiblingElement(name.c_str()))
    list.emplace_back(*e, *file_, *asked_);
  return list;
}

std::optional<Tag> Tag::find(const std::string& name) const {
  const std::vector<Tag> list = all(name);
  if (list.size() > 1) list[1].fail("there may be only one in <" + this->name() + ">");
  return list.empty() ? std::nullopt : std::optional<Tag>(list.front());
}

Tag Tag::one(const std::string& name) const {
  const std::optional<Tag> tag = find(name);
  if (!tag) fail("the tag <" + name + "> is missing");
  return *tag;
}

void Tag::ignore(const Names& names) const {
  for (const char* name : names) {
    for (const Tag& tag : all(name)) asked_->tags[tag.element_].everything = true;
  }
}

std::optional<std::string> Tag::find_attribute(const char* name) const {
  asked_->tags[element_].attributes.insert(name);
  const char* value = element_->Attribute(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

std::string Tag::attribute(const char* name) const {
  const auto value = find_attribute(name);
  if (!value) fail("the attribute " + std::string(name) + " is missing");
  return *value;
}

int Tag::integer_attribute(const char* name) const { return to_integer(attribute(name), 1); }

std::string Tag::attribute(const char* name, const Names& allowed) const {
  std::string value = attribute(name);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
    fail("the " + std::string(name) + " \"" + value + "\" is not supported; allowed: " + listed(allowed));
  return value;
}

std::string Tag::text() const {
  const char* text = element_->GetText();
  return text ? text : "";
}

double Tag::to_number(const std::string& word) const {
  double value = 0;
  if (!boost::conversion::try_lexical_convert(word, value) || !std::isfinite(value))
    fail("\"" + word.substr(0, 40) + "\" is not a finite number");
  return value;
}

int Tag::to_integer(const std::string& word, int least, int most) const {
  int value = 0;
  if (!boost::conversion::try_lexical_convert(word, value) || value < least || value > most) {
    fail("\"" + word.substr(0, 40) + "\" is not an integer from " + std::to_string(least) + " to " +
         std::to_string(most));
  }
  return value;
}

double Tag::number(const Range& range) const {
  const double value = to_number(text());
  if (!range.holds(value)) fail("the value must be " + std::string(range.words));
  return value;
}

int Tag::integer(int least, int most) const { return to_integer(text(), least, most); }

std::size_t Tag::one_of(const Names& words) const {
  const auto word = std::find(words.begin(), words.end(), text());
  if (word == words.end()) fail("\"" + text() + "\" is not supported; allowed: " + listed(words));
  return indexing::entries(word - words.begin());
}

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
  for (const std::string& word : words(text())) values.push_back(to_integer(word, 1));
  return values;
}

void Tag::take(const char* name, double& value, const Range& range) const {
  if (const auto tag = find(name)) value = tag->number(range);
}

void Tag::take(const char* name, int& value, int least, int most) const {
  if (const auto tag = find(name)) value = tag->integer(least, most);
}

void Tag::must_be(const char* name, const Names& words) const {
  if (const auto tag = find(name)) tag->one_of(words);
}

void read_xml(const std::string& path, const std::function<void(const Tag&)>& read) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError("the model file " + path + " cannot be read: " + error.message());
  if (size > largest_file) throw InputError("the model file " + path + " is larger than 1 GiB");
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);
  if (document.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS || document.RootElement() == nullptr) {
    throw InputError(path + ", line " + std::to_string(document.ErrorLineNum()) + ": no valid XML (" +
                     document.ErrorName() + ")");
  }
  Asked asked;
  const Tag root(*document.RootElement(), path, asked);
  read(root);
  root.check();
}

}  // namespace standalone

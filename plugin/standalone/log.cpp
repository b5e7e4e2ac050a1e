#include "log.h"

#include "error.h"

#include <cstdarg>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <utility>

namespace standalone {
namespace {

constexpr std::size_t box_width = 71;

std::string framed(const std::string& text) {
  return " * " + text + std::string(box_width - std::min(box_width, text.size() + 1), ' ') + "*\n";
}

}  // namespace

void Log::open(const std::string& path) {
  file_.open(path);
  if (!file_) throw InputError("the log file " + path + " cannot be written");
}

void Log::write(const std::string& text) {
  if (on_screen_) std::cout << text;
  if (file_.is_open()) file_ << text;
}

void Log::print(const char* format, ...) {  // NOLINT(modernize-avoid-variadic-functions): checked by the compiler
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(static_cast<std::size_t>(std::max(size, 0)) + 1, '\0');
  std::vsnprintf(text.data(), text.size(), format, again);
  va_end(again);
  text.pop_back();
  write(text);
}

void Log::box(const char* title, const std::string& text) {
  const std::string title_text = title;
  std::string frame = framed(std::string((box_width - title_text.size()) / 2, ' ') + title_text);
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + word.size() > box_width - 2) frame += framed(std::exchange(line, {}));
    line += (line.empty() ? "" : " ") + word;
  }
  const std::string edge = " " + std::string(box_width + 2, '*') + "\n";
  write("\n" + edge + frame + framed(line) + edge);
}

}  // namespace standalone

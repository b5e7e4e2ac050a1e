#include "log.h"

#include "error.h"

#include <cstdarg>

namespace standalone {
namespace {

constexpr std::size_t box_width = 71;

std::string framed(const std::string& text) {
  return " * " + text + std::string(box_width - std::min(box_width, text.size() + 1), ' ') + "*\n";
}

}  // namespace

void Log::open(const std::string& path) {
  file_.reset(std::fopen(path.c_str(), "w"));
  if (!file_) throw InputError("the log file " + path + " cannot be written");
}

// NOLINTNEXTLINE(modernize-avoid-variadic-functions): checked by the compiler
void Log::print(const char* format, ...) const {
  for (std::FILE* to : {on_screen_ ? stdout : nullptr, file_.get()}) {
    if (to == nullptr) continue;
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(to, format, arguments);
    va_end(arguments);
  }
}

void Log::box(const char* title, const std::string& text) const {
  const std::string edge = " " + std::string(box_width + 2, '*') + "\n";
  print("\n%s%s%s%s", edge.c_str(), framed(title).c_str(), framed(text).c_str(), edge.c_str());
}

}  // namespace standalone

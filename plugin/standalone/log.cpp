#include "log.h"

#include "error.h"

#include <cstdarg>

namespace standalone {

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
  const std::string edge(71, '*');
  print("\n %s\n * %s *\n * %s *\n %s\n", edge.c_str(), title, text.c_str(), edge.c_str());
}

}  // namespace standalone

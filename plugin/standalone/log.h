/// The log of a run, on the screen and in a file, in FEBio's wording.
#pragma once

#include <fstream>
#include <string>

namespace standalone {

class Log {
 public:
  /// Writes to the screen only until a file is opened. Throws InputError where the file cannot be written.
  void open(const std::string& path);

  /// Like printf.
  void print(const char* format, ...) __attribute__((format(printf, 2, 3)));
  /// Framed messages, with the words of a title such as "ERROR" or "WARNING" first.
  void box(const char* title, const std::string& text);

 private:
  void write(const std::string& text);

  std::ofstream file_;
};

}  // namespace standalone

/// The log of a run, on the screen and in a file, in FEBio's wording.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace standalone {

class Log {
 public:
  explicit Log(bool on_screen = true) : on_screen_(on_screen) {}

  /// Writes to a file as well from now on. Throws InputError if the file cannot be written.
  void open(const std::string& path);

  /// Like printf.
  void print(const char* format, ...) const __attribute__((format(printf, 2, 3)));
  /// Framed messages, with the words of a title such as "ERROR" or "WARNING" first.
  void box(const char* title, const std::string& text) const;

 private:
  bool on_screen_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, std::fclose};
};

}  // namespace standalone

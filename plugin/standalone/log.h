/// The log of a run on the screen and in a file, in the wording of FEBio.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace standalone {

/// Writes the log.
class Log {
 public:
  explicit Log(bool on_screen = true) : on_screen_(on_screen) {}

  /// Also writes to a file from now on. Throws InputError if the file cannot be written.
  void open(const std::string& path);

  /// Writes formatted text; arguments as for printf.
  void print(const char* format, ...) const __attribute__((format(printf, 2, 3)));
  /// Writes a framed message. `title`: heading such as "ERROR" or "WARNING".
  void box(const char* title, const std::string& text) const;

 private:
  bool on_screen_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, std::fclose};
};

}  // namespace standalone

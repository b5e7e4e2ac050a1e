/// Lines of a contact in FEBio's log.
#pragma once

#include <FECore/FECoreBase.h>
#include <FECore/log.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

/// Writes sentences that begin with the type and name of the contact to FEBio's log.
class ContactLog {
 public:
  explicit ContactLog(FECoreBase& contact) : contact_(contact) {}

  /// Writes a sentence.
  void say(const std::string& sentence) const {
    feLogEx(contact_.GetFEModel(), "%s%s\n", subject().c_str(), sentence.c_str());
  }
  /// Writes a sentence as an error.
  void error(const std::string& sentence) const {
    feLogErrorEx(contact_.GetFEModel(), "%s%s", subject().c_str(), sentence.c_str());
  }
  /// Writes sentences as errors.
  void errors(const std::vector<std::string>& sentences) const {
    for (const std::string& sentence : sentences) error(sentence);
  }

  /// Ends the run after an error has been logged. The exception is not one of FEBio's, after which FEBio would repeat
  /// the step with the same error.
  [[noreturn]] void end_run() const { throw std::runtime_error(subject() + "stops the run, see the error above."); }

  // The next functions write sentences that name the contact themselves.
  void line(const std::string& sentence) const { feLogEx(contact_.GetFEModel(), "%s\n", sentence.c_str()); }
  /// Writes a sentence that this log has not written so before.
  void line_once(const std::string& sentence) {
    if (written_.insert(sentence).second) line(sentence);
  }
  void warning(const std::string& sentence) const { feLogWarningEx(contact_.GetFEModel(), "%s", sentence.c_str()); }

  std::string name() const { return contact_.GetName(); }
  /// Type and name of the contact.
  std::string title() const { return std::string(contact_.GetTypeStr()) + " \"" + name() + "\""; }

 private:
  std::string subject() const { return title() + ": "; }

  FECoreBase& contact_;
  std::set<std::string> written_;  ///< sentences that line_once() has written
};

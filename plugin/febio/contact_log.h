/// Lines of a contact in FEBio's log.
#pragma once

#include <FECore/FECoreBase.h>
#include <FECore/log.h>

#include <stdexcept>
#include <string>
#include <vector>

/// Sentences that begin with the name of the contact.
class ContactLog {
 public:
  explicit ContactLog(FECoreBase& contact) : contact_(contact) {}

  void say(const std::string& sentence) const {
    feLogEx(contact_.GetFEModel(), "%s%s\n", subject().c_str(), sentence.c_str());
  }
  void error(const std::string& sentence) const {
    feLogErrorEx(contact_.GetFEModel(), "%s%s", subject().c_str(), sentence.c_str());
  }
  void errors(const std::vector<std::string>& sentences) const {
    for (const std::string& sentence : sentences) error(sentence);
  }

  /// Ends the run after an error: FEBio repeats steps after its own exceptions, and the fault would recur.
  [[noreturn]] void end_run() const { throw std::runtime_error(subject() + "stops the run, see the error above."); }

  // Sentences that name the contact themselves
  void line(const std::string& sentence) const { feLogEx(contact_.GetFEModel(), "%s\n", sentence.c_str()); }
  void warning(const std::string& sentence) const { feLogWarningEx(contact_.GetFEModel(), "%s", sentence.c_str()); }

  std::string name() const { return contact_.GetName(); }
  /// Type and name.
  std::string title() const { return std::string(contact_.GetTypeStr()) + " \"" + name() + "\""; }

 private:
  std::string subject() const { return title() + ": "; }

  FECoreBase& contact_;
};

/// mixture-contact: runs a model with contact between mixtures, without FEBio.

#include "analysis.h"
#include "error.h"
#include "host/contact_types.h"
#include "problem.h"
#include "reader.h"

#include <boost/program_options.hpp>

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

namespace {

namespace options = boost::program_options;

int run_model(const std::string& path, bool check_only) {
  standalone::Log log;
  try {
    const standalone::Model model = standalone::read_model(path);
    if (check_only) {
      const standalone::Problem problem(model);
      log.print("%s: the model is complete and supported.\n", path.c_str());
      return 0;
    }
    log.open(std::filesystem::path(path).replace_extension("log").string());
    return standalone::run(model, log) ? 0 : 1;
  } catch (const standalone::InputError& error) {
    log.box("ERROR", error.what());
  } catch (const std::bad_alloc&) {
    log.box("ERROR", "There is not enough memory for this model.");
  } catch (const std::exception& error) {
    log.box("ERROR", std::string("Unexpected: ") + error.what());
  }
  log.print("\n E R R O R   T E R M I N A T I O N\n\n");
  return 1;
}

int run_command_line(int argc, const char* const* argv) {
  options::options_description known(
      "Usage: mixture-contact [options] model.feb\n\nRuns a model (a subset of FEBio XML 4.0) and writes "
      "log and data in its folder.\n\nOptions");
  known.add_options()("help,h", "show this text")("model", options::value<std::string>(), "the model")(
      "check", "read the model and say what is wrong with it, without running it")(
      "contact-types", "print the contact types of febio4's plugin and their parameters as JSON");
  options::variables_map given;
  try {
    options::store(options::command_line_parser(argc, argv)
                       .options(known)
                       .positional(options::positional_options_description().add("model", 1))
                       .run(),
                   given);
  } catch (const options::error& error) {
    std::cerr << "mixture-contact: " << error.what() << '\n';
    return 1;
  }
  if (given.count("contact-types") > 0) {
    std::cout << contact_types_json();
    return 0;
  }
  if (given.count("help") > 0 || given.count("model") == 0) {
    std::cout << known << '\n';
    return given.count("help") > 0 ? 0 : 1;
  }
  return run_model(given["model"].as<std::string>(), given.count("check") > 0);
}

}  // namespace

int main(int argc, char** argv) {  // NOLINT(misc-const-correctness): the signature of main
  try {
    return run_command_line(argc, argv);
  } catch (...) {
    return 1;
  }
}

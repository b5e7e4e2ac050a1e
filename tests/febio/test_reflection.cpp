/// Tests the parameters that FEBio's reflection, and therefore FEBio Studio, shows for the contact. The plugin is
/// loaded as febio4 loads it.
#include <FECore/FECoreBase.h>
#include <FECore/FECoreKernel.h>
#include <FECore/FEModel.h>
#include <FECore/FESurfacePairConstraint.h>
#include <FECore/units.h>
#include <dlfcn.h>

#include <boost/test/unit_test.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace {

FECoreKernel& kernel_with_plugin() {
  static FECoreKernel& kernel = [&]() -> FECoreKernel& {
    FECoreKernel& febio = FECoreKernel::GetInstance();
    void* plugin = dlopen(MIXCONTACT_PLUGIN_FILE, RTLD_NOW);
    BOOST_REQUIRE_MESSAGE(plugin != nullptr, dlerror());
    reinterpret_cast<void (*)(FECoreKernel&)>(dlsym(plugin, "PluginInitialize"))(febio);
    return febio;
  }();
  return kernel;
}

/// The parameters of an object that FEBio has created, by name.
class Reflection {
 public:
  Reflection(SUPER_CLASS_ID kind, const char* type) {
    object_.reset(static_cast<FECoreBase*>(kernel_with_plugin().Create(kind, type, &model_)));
    BOOST_REQUIRE(object_ != nullptr);
  }
  FEParameterList& parameters() { return object_->GetParameterList(); }
  FEParam& parameter(const char* name) {
    FEParam* found = parameters().FindFromName(name);
    BOOST_REQUIRE_MESSAGE(found != nullptr, name);
    return *found;
  }

 private:
  FEModel model_;
  std::unique_ptr<FECoreBase> object_;
};

/// True for a parameter of FEBio's base class that the contact does not use.
bool is_of_base(const FEParam& parameter) {
  const std::string name = parameter.name();
  return name == "penalty_sf" || name == "max_penalty_sf";
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_parameter_has_a_long_name_of_its_own_and_a_unit) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  std::set<std::string> seen;
  FEParameterList& all = contact.parameters();
  auto parameter = all.first();
  for (int i = 0; i < all.Parameters(); ++i, ++parameter) {
    if (is_of_base(*parameter)) continue;
    const std::string name = parameter->name();
    BOOST_REQUIRE_MESSAGE(parameter->longName() != nullptr, name);
    BOOST_TEST(!std::string(parameter->longName()).empty(), name);
    BOOST_TEST(seen.insert(parameter->longName()).second, name);
    BOOST_TEST(parameter->units() != nullptr, name);
  }
  BOOST_TEST(seen.size() == 44);
}

BOOST_AUTO_TEST_CASE(parameters_stand_under_the_headings_of_the_documentation) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  FEParameterList& all = contact.parameters();
  std::map<std::string, int> shown;
  auto parameter = all.first();
  for (int i = 0; i < all.Parameters(); ++i, ++parameter) {
    const int group = parameter->GetParamGroup();
    if ((parameter->GetFlags() & FE_PARAM_HIDDEN) == 0) ++shown[group < 0 ? "" : all.GetParameterGroupName(group)];
  }
  for (const char* heading :
       {"Effects", "Enforcement", "Ambient values", "Surfaces and integration", "Solution", "Friction", "Membrane"}) {
    BOOST_TEST(shown.erase(heading) == 1, heading);
  }
  BOOST_TEST(shown.empty());
}

BOOST_AUTO_TEST_CASE(parameters_of_old_models_are_hidden_and_the_others_are_not) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  const auto is_hidden = [&](const char* name) { return (contact.parameter(name).GetFlags() & FE_PARAM_HIDDEN) != 0; };
  for (const char* name : {"knmult", "smooth_aug", "smooth_fls", "extrapolation"}) BOOST_TEST(is_hidden(name), name);
  for (const char* name : {"penalty", "laugon", "ambient_pressure", "fric_coeff"}) BOOST_TEST(!is_hidden(name), name);
}

BOOST_AUTO_TEST_CASE(values_that_load_curves_may_change_can_have_them) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  for (const char* name :
       {"penalty", "pressure_penalty", "concentration_penalty", "fric_coeff", "tolerance", "ambient_pressure"})
    BOOST_TEST(contact.parameter(name).IsVolatile(), name);
}

BOOST_AUTO_TEST_CASE(units_are_those_of_the_quantities) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  for (const char* name : {"gaptol", "search_radius", "offset"})
    BOOST_TEST(std::string(contact.parameter(name).units()) == UNIT_LENGTH);
  for (const char* name : {"ptol", "ambient_pressure"})
    BOOST_TEST(std::string(contact.parameter(name).units()) == UNIT_PRESSURE);
  BOOST_TEST(std::string(contact.parameter("ctol").units()) == UNIT_CONCENTRATION);
  BOOST_TEST(std::string(contact.parameter("tolerance").units()) == UNIT_NONE);
}

BOOST_AUTO_TEST_CASE(choices_have_their_names) {
  Reflection contact(FESurfacePairConstraint::superClassID(), "sliding-mixture");
  const auto names = [&](const char* parameter) {
    std::vector<std::string> all;
    for (const char* name = contact.parameter(parameter).enums(); *name != 0; name += all.back().size() + 1)
      all.emplace_back(name);
    return all;
  };
  BOOST_TEST(names("laugon") == (std::vector<std::string>{"PENALTY", "AUGLAG", "LAGMULT"}),
             boost::test_tools::per_element());
  BOOST_TEST(names("integration") == (std::vector<std::string>{"gauss", "segments"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(ambient_concentrations_have_a_solute_and_a_value) {
  Reflection ambient(FECLASS_ID, "mixture_ambient_concentration");
  BOOST_TEST(std::string(ambient.parameter("sol").enums()) == "$(solutes)");
  BOOST_TEST(std::string(ambient.parameter("mixture_ambient_concentration").units()) == UNIT_CONCENTRATION);
}

BOOST_AUTO_TEST_CASE(coefficients_of_membranes_have_a_solute_and_a_value) {
  for (const char* name : {"mixture_solute_permeance", "mixture_reflection"}) {
    Reflection film(FECLASS_ID, name);
    BOOST_TEST(std::string(film.parameter("sol").enums()) == "$(solutes)");
    BOOST_TEST(film.parameter(name).longName() != nullptr);
  }
}

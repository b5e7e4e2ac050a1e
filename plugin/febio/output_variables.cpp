#include "output_variables.h"

#include "contact/base/indexed_vector.h"
#include "material_properties.h"
#include "mixture_contact.h"

#include <FECore/FECoreFactory.h>
#include <FECore/FECoreKernel.h>
#include <FECore/FEModel.h>
#include <FECore/log.h>

#include <algorithm>
#include <string>
#include <utility>

using mixture_contact::Index;
using mixture_contact::MatrixXd;

namespace {

constexpr int logged_solutes = 8;

/// The reported quantity of an exchanged field.
enum class Quantity { flux, jump };

double nodal_value(const FEMixtureSurface& surface, Quantity quantity, int solute, int node) {
  const int field = surface.exchanged_field(solute);
  const MatrixXd& values = quantity == Quantity::flux ? surface.nodal_output().flux : surface.nodal_output().jump;
  return field < 0 || node >= values.cols() ? 0.0 : values(field, node);
}

double own_flow(const FEMixtureSurface& surface, int solute) {
  const int field = surface.exchanged_field(solute);
  return field < 0 || field >= surface.total().flow.size() ? 0.0 : surface.total().flow[field];
}

/// The sum of a value over all contacts that share the surface.
template <class Value>
auto sum_over_contacts(FEMixtureSurface& surface, const Value& value) {
  auto sum = value(surface);
  sum *= 0;
  for (const FEMixtureSurface* each : surface.of_all_contacts()) sum += value(*each);
  return sum;
}

double flow(FEMixtureSurface& surface, int solute) {
  return sum_over_contacts(surface, [&](const FEMixtureSurface& each) { return own_flow(each, solute); });
}

mixture_contact::Vector3d contact_force(FEMixtureSurface& surface) {
  return sum_over_contacts(surface, [](const FEMixtureSurface& each) { return each.total().force; });
}

mixture_contact::Vector3d friction_force(FEMixtureSurface& surface) {
  return sum_over_contacts(surface, [](const FEMixtureSurface& each) { return each.total().friction; });
}

/// The contact surface that a plot or log record refers to: the surface itself, or the one of the same name in a
/// contact.
FEMixtureSurface* contact_surface(FEModel& fem, FESurface& surface) {
  if (auto* own = dynamic_cast<FEMixtureSurface*>(&surface)) return own;
  for (int i = 0; i < fem.SurfacePairConstraints(); ++i) {
    auto* contact = dynamic_cast<FEMixtureContact*>(fem.SurfacePairConstraint(i));
    if (contact == nullptr) continue;
    for (FESurface* candidate : {contact->GetPrimarySurface(), contact->GetSecondarySurface()}) {
      if (candidate->GetName() == surface.GetName()) return dynamic_cast<FEMixtureSurface*>(candidate);
    }
  }
  return nullptr;
}

void name_solutes(FEPlotData& data, FEModel& fem) {
  std::vector<std::string> names = solute_names(fem);
  data.SetArraySize(mixture_contact::number_of(names));
  data.SetArrayNames(names);
}

// ------------------------------------------------------------ plot file

template <Quantity quantity>
class FEPlotSolvent : public FEPlotSurfaceData {
 public:
  explicit FEPlotSolvent(FEModel* fem) : FEPlotSurfaceData(fem, PLT_FLOAT, FMT_NODE) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    const auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    for (int node = 0; node < surface.Nodes(); ++node) stream << nodal_value(*own, quantity, -1, node);
    return true;
  }
};

template <Quantity quantity>
class FEPlotSolute : public FEPlotSurfaceData {
 public:
  explicit FEPlotSolute(FEModel* fem) : FEPlotSurfaceData(fem, PLT_ARRAY, FMT_NODE) { name_solutes(*this, *fem); }
  bool Save(FESurface& surface, FEDataStream& stream) override {
    const auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    for (int node = 0; node < surface.Nodes(); ++node) {
      for (int solute = 0; solute < GetArraysize(); ++solute) stream << nodal_value(*own, quantity, solute, node);
    }
    return true;
  }
};

class FEPlotCoverage : public FEPlotSurfaceData {
 public:
  explicit FEPlotCoverage(FEModel* fem) : FEPlotSurfaceData(fem, PLT_FLOAT, FMT_NODE) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    const auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    const auto& area = own->nodal_output().tributary_area;
    for (int node = 0; node < surface.Nodes(); ++node) stream << (node < area.size() ? area[node] : 0.0);
    return true;
  }
};

class FEPlotSolventFlow : public FEPlotSurfaceData {
 public:
  explicit FEPlotSolventFlow(FEModel* fem) : FEPlotSurfaceData(fem, PLT_FLOAT, FMT_REGION) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    stream << flow(*own, -1);
    return true;
  }
};

class FEPlotSoluteFlow : public FEPlotSurfaceData {
 public:
  explicit FEPlotSoluteFlow(FEModel* fem) : FEPlotSurfaceData(fem, PLT_ARRAY, FMT_REGION) { name_solutes(*this, *fem); }
  bool Save(FESurface& surface, FEDataStream& stream) override {
    auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    for (int solute = 0; solute < GetArraysize(); ++solute) stream << flow(*own, solute);
    return true;
  }
};

/// Plot variable with a number at each node.
template <double (*value)(const FEMixtureSurface&, int)>
class FEPlotAtNodes : public FEPlotSurfaceData {
 public:
  explicit FEPlotAtNodes(FEModel* fem) : FEPlotSurfaceData(fem, PLT_FLOAT, FMT_NODE) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    const auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    for (int node = 0; node < surface.Nodes(); ++node) stream << value(*own, node);
    return true;
  }
};

/// Plot variable with a vector at each node, from a matrix of FrictionOutput.
template <mixture_contact::Matrix3Xd mixture_contact::FrictionOutput::* vectors>
class FEPlotVectorsAtNodes : public FEPlotSurfaceData {
 public:
  explicit FEPlotVectorsAtNodes(FEModel* fem) : FEPlotSurfaceData(fem, PLT_VEC3F, FMT_NODE) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    const auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    for (int node = 0; node < surface.Nodes(); ++node)
      stream << to_febio(vector_at(own->nodal_output().friction.*vectors, node));
    return true;
  }
};

double effective_friction(const FEMixtureSurface& surface, int node) {
  return surface.nodal_output().effective_friction(node);
}

double fluid_load_support(const FEMixtureSurface& surface, int node) {
  return surface.nodal_output().fluid_load_support(node);
}

double slip_status(const FEMixtureSurface& surface, int node) {
  return static_cast<double>(status_of(surface.nodal_output().friction, node));
}

/// A value of BreakingOutput at a node; 0 if the bonds cannot break.
template <mixture_contact::VectorXd mixture_contact::BreakingOutput::* values>
double of_bonds(const FEMixtureSurface& surface, int node) {
  return value_at(surface.nodal_output().breaking.*values, node);
}

/// The power that friction dissipates in a step.
double friction_power(FEMixtureSurface& surface, FEModel& fem) {
  const double dt = fem.GetTime().timeIncrement;
  const auto dissipation = [](const FEMixtureSurface& each) { return each.total().dissipation; };
  return dt > 0 ? sum_over_contacts(surface, dissipation) / dt : 0.0;
}

class FEPlotFrictionForce : public FEPlotSurfaceData {
 public:
  explicit FEPlotFrictionForce(FEModel* fem) : FEPlotSurfaceData(fem, PLT_VEC3F, FMT_REGION) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    stream << to_febio(friction_force(*own));
    return true;
  }
};

class FEPlotFrictionPower : public FEPlotSurfaceData {
 public:
  explicit FEPlotFrictionPower(FEModel* fem) : FEPlotSurfaceData(fem, PLT_FLOAT, FMT_REGION) {}
  bool Save(FESurface& surface, FEDataStream& stream) override {
    auto* own = dynamic_cast<FEMixtureSurface*>(&surface);
    if (own == nullptr) return false;
    stream << friction_power(*own, *GetFEModel());
    return true;
  }
};

// ------------------------------------------------------------ log file

/// Log variable with a number per surface. A surface that belongs to no sliding-mixture contact is reported once.
class FELogMixtureSurface : public FELogSurfaceData {
 public:
  using FELogSurfaceData::FELogSurfaceData;
  double value(FESurface& surface) override {
    FEMixtureSurface* const own = contact_surface(*GetFEModel(), surface);
    if (own != nullptr) return value_of(*own);
    if (!warned_)
      feLogWarning("Log data \"%s\": \"%s\" is not a surface of a sliding-mixture contact.", GetTypeStr(),
                   surface.GetName().c_str());
    warned_ = true;
    return 0;
  }

 private:
  virtual double value_of(FEMixtureSurface& surface) const = 0;
  bool warned_ = false;
};

template <int component>
class FELogContactForce : public FELogMixtureSurface {
  using FELogMixtureSurface::FELogMixtureSurface;
  double value_of(FEMixtureSurface& surface) const override { return contact_force(surface)[component]; }
};

template <int component>
class FELogFrictionForce : public FELogMixtureSurface {
  using FELogMixtureSurface::FELogMixtureSurface;
  double value_of(FEMixtureSurface& surface) const override { return friction_force(surface)[component]; }
};

class FELogFrictionPower : public FELogMixtureSurface {
  using FELogMixtureSurface::FELogMixtureSurface;
  double value_of(FEMixtureSurface& surface) const override { return friction_power(surface, *GetFEModel()); }
};

/// Log variable with an energy of bonds, or the area of broken bonds.
template <double mixture_contact::BondEnergy::* part>
class FELogBonds : public FELogMixtureSurface {
  using FELogMixtureSurface::FELogMixtureSurface;
  double value_of(FEMixtureSurface& surface) const override {
    return sum_over_contacts(surface, [](const FEMixtureSurface& each) { return each.total().bonds.*part; });
  }
};

/// Log variable with the flow of a solute; `solute` -1: the solvent.
template <int solute>
class FELogFlow : public FELogMixtureSurface {
  using FELogMixtureSurface::FELogMixtureSurface;
  double value_of(FEMixtureSurface& surface) const override { return flow(surface, solute); }
};

/// Registers a class under a name. FEBio stores the pointers; factory and name therefore exist as long as the process.
template <class T>
void offer(const std::string& name) {
  static const std::string kept = name;
  static const FERegisterClass_T<T> factory(T::superClassID(), kept.c_str(), T::BaseClassName(), kept.c_str());
}

/// The part of the areas of a facet's nodes that faces the other surface of a contact.
double coverage(const FEMixtureSurface& surface, const FESurfaceElement& element) {
  const auto& area = surface.nodal_output().tributary_area;
  double sum = 0;
  for (int a = 0; a < element.Nodes(); ++a) {
    const int node = mixture_contact::at(element.m_lnode, a);
    if (node < area.size()) sum += area[node];
  }
  return sum;
}

/// The surface of the contact that covers most of a facet, if several contacts share it; null if none is active.
const FEMixtureSurface* covering(FEMixtureSurface& surface, const FESurfaceElement& element) {
  const std::vector<const FEMixtureSurface*> all = surface.of_all_contacts();
  const auto most = std::max_element(all.begin(), all.end(), [&](const auto* one, const auto* two) {
    return coverage(*one, element) < coverage(*two, element);
  });
  return most == all.end() ? nullptr : *most;
}

/// The mean of the nodal values of a facet; 0 if the facet belongs to no contact.
template <class Value>
double mean_of_nodes(FEModel& fem, FESurfaceElement& element, const Value& value) {
  auto* surface = dynamic_cast<FESurface*>(element.GetMeshPartition());
  FEMixtureSurface* const known = surface ? contact_surface(fem, *surface) : nullptr;
  const FEMixtureSurface* const own = known ? covering(*known, element) : nullptr;
  if (own == nullptr) return 0;
  double sum = 0;
  for (int a = 0; a < element.Nodes(); ++a) sum += value(*own, mixture_contact::at(element.m_lnode, a));
  return sum / element.Nodes();
}

template <Quantity quantity, int solute>
class FELogFacet : public FELogFaceData {
 public:
  using FELogFaceData::FELogFaceData;
  double value(FESurfaceElement& element) override {
    return mean_of_nodes(*GetFEModel(), element, [](const FEMixtureSurface& surface, int node) {
      return nodal_value(surface, quantity, solute, node);
    });
  }
};

template <double (*nodal)(const FEMixtureSurface&, int)>
class FELogMeanOfNodes : public FELogFaceData {
 public:
  using FELogFaceData::FELogFaceData;
  double value(FESurfaceElement& element) override { return mean_of_nodes(*GetFEModel(), element, nodal); }
};

template <mixture_contact::Matrix3Xd mixture_contact::FrictionOutput::* vectors, int component>
double component_of(const FEMixtureSurface& surface, int node) {
  return vector_at(surface.nodal_output().friction.*vectors, node)[component];
}

// ------------------------------------------------------------ registration

template <int... solutes>
void offer_solute_logs(std::integer_sequence<int, solutes...> /*unused*/) {
  const auto named = [](const char* what, int solute) { return std::string(what) + " " + std::to_string(solute + 1); };
  (offer<FELogFlow<solutes>>(named("contact solute flow", solutes)), ...);
  (offer<FELogFacet<Quantity::flux, solutes>>(named("contact solute flux", solutes)), ...);
  (offer<FELogFacet<Quantity::jump, solutes>>(named("contact solute jump", solutes)), ...);
}

}  // namespace

void register_output_variables() {
  offer<FEPlotSolvent<Quantity::flux>>("contact solvent flux");
  offer<FEPlotSolvent<Quantity::jump>>("contact solvent jump");
  offer<FEPlotSolute<Quantity::flux>>("contact solute flux");
  offer<FEPlotSolute<Quantity::jump>>("contact solute jump");
  offer<FEPlotCoverage>("contact coverage");
  offer<FEPlotSolventFlow>("contact solvent flow");
  offer<FEPlotSoluteFlow>("contact solute flow");
  using mixture_contact::FrictionOutput;
  offer<FEPlotVectorsAtNodes<&FrictionOutput::traction>>("contact friction");
  offer<FEPlotVectorsAtNodes<&FrictionOutput::slip>>("contact slip");
  offer<FEPlotAtNodes<slip_status>>("contact slip status");
  offer<FEPlotAtNodes<effective_friction>>("contact friction coefficient");
  offer<FEPlotAtNodes<fluid_load_support>>("contact fluid load support");
  offer<FEPlotFrictionForce>("contact friction force");
  offer<FEPlotFrictionPower>("contact friction power");
  using mixture_contact::BreakingOutput;
  offer<FEPlotAtNodes<of_bonds<&BreakingOutput::damage>>>("contact damage");
  offer<FEPlotAtNodes<of_bonds<&BreakingOutput::opening>>>("contact opening");
  offer<FEPlotAtNodes<of_bonds<&BreakingOutput::energy>>>("contact fracture energy");
  offer<FEPlotAtNodes<of_bonds<&BreakingOutput::broken_at>>>("contact break time");
  offer<FELogMeanOfNodes<of_bonds<&BreakingOutput::damage>>>("contact damage");
  offer<FELogMeanOfNodes<of_bonds<&BreakingOutput::opening>>>("contact opening");
  offer<FELogMeanOfNodes<of_bonds<&BreakingOutput::energy>>>("contact fracture energy");
  offer<FELogBonds<&mixture_contact::BondEnergy::dissipated>>("fracture energy");
  offer<FELogBonds<&mixture_contact::BondEnergy::viscous>>("viscous energy");
  offer<FELogBonds<&mixture_contact::BondEnergy::stored>>("bond energy");
  offer<FELogBonds<&mixture_contact::BondEnergy::broken_area>>("broken area");
  offer<FELogFrictionForce<0>>("friction_force.x");
  offer<FELogFrictionForce<1>>("friction_force.y");
  offer<FELogFrictionForce<2>>("friction_force.z");
  offer<FELogFrictionPower>("friction power");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::traction, 0>>>("contact friction.x");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::traction, 1>>>("contact friction.y");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::traction, 2>>>("contact friction.z");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::slip, 0>>>("contact slip.x");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::slip, 1>>>("contact slip.y");
  offer<FELogMeanOfNodes<component_of<&FrictionOutput::slip, 2>>>("contact slip.z");
  offer<FELogMeanOfNodes<slip_status>>("contact slip status");
  offer<FELogMeanOfNodes<effective_friction>>("contact friction coefficient");
  offer<FELogMeanOfNodes<fluid_load_support>>("contact fluid load support");
  offer<FELogContactForce<0>>("contact_force.x");
  offer<FELogContactForce<1>>("contact_force.y");
  offer<FELogContactForce<2>>("contact_force.z");
  offer<FELogFlow<-1>>("contact solvent flow");
  offer<FELogFacet<Quantity::flux, -1>>("contact solvent flux");
  offer<FELogFacet<Quantity::jump, -1>>("contact solvent jump");
  offer_solute_logs(std::make_integer_sequence<int, logged_solutes>());
}

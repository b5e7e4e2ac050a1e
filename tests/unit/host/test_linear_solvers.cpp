#include "host/linear_solvers.h"

#include <boost/test/unit_test.hpp>

namespace {
constexpr MatrixKind penalty{false, false};
constexpr MatrixKind symmetric{true, false};
constexpr MatrixKind multipliers{false, true};
}  // namespace

BOOST_AUTO_TEST_CASE(direct_solvers_take_every_matrix) {
  for (const char* type : {"pardiso", "mkl_dss", "superlu_mt"}) {
    for (const MatrixKind matrix : {penalty, symmetric, multipliers})
      BOOST_TEST(linear_solver_complaint(type, matrix) == "");
  }
}

BOOST_AUTO_TEST_CASE(solvers_of_symmetric_matrices_take_nothing_else) {
  for (const char* type : {"skyline", "cg", "hypre_pcg_amg"}) {
    BOOST_TEST(linear_solver_complaint(type, symmetric) == "");
    for (const MatrixKind matrix : {penalty, multipliers}) {
      const std::string said = linear_solver_complaint(type, matrix);
      BOOST_TEST(said.find(type) != std::string::npos);
      BOOST_TEST(said.find("pardiso") != std::string::npos);
    }
    BOOST_TEST(linear_solver_complaint(type, {true, true}).find("LAGMULT") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(iterative_solvers_are_told_from_multipliers) {
  for (const char* type : {"fgmres", "bicgstab", "hypre_gmres"}) {
    BOOST_TEST(linear_solver_complaint(type, penalty) == "");
    BOOST_TEST(linear_solver_complaint(type, multipliers).find("LAGMULT") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(mixed_forms_are_for_solvers_that_scale_the_matrix) {
  BOOST_TEST(takes_mixed_form("pardiso"));
  for (const char* type : {"mkl_dss", "superlu_mt", "skyline", "cg", "fgmres", "hypre_gmres"})
    BOOST_TEST(!takes_mixed_form(type));
}

#include "contact/interface/corrections.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace test;

namespace {

/// A plate in contact with a larger one, whose nodes face the plate or leave it as the plate slides.
struct SlidingPlate {
  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  SlidingPlate() : scene(plates(), effects_of(true, 1), explicit_settings(4, 2, 8)), contact(scene.contact()) {
    contact->begin_iteration(scene.fields);
    contact->hold_nodes_in_contact();
  }

  static PerSide<Grid> plates() {
    PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.01, 2, 8);
    grids[Side::secondary].high[0] = 2;
    return grids;
  }

  void slide(double distance) {
    scene.fields[Side::primary].position.row(0).array() += distance;
    contact->project(scene.position());
  }

  /// Slides the plate and begins an iteration.
  void iterate(double distance) {
    slide(distance);
    contact->begin_iteration(scene.fields);
    contact->hold_nodes_in_contact();
  }

  std::ptrdiff_t facing() const {
    const NodeFlags nodes = contact->nodes_in_contact()[Side::secondary];
    return std::count(nodes.begin(), nodes.end(), true);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_state_at_which_other_nodes_face_contact_is_no_solution) {
  SlidingPlate plate;
  BOOST_TEST(faces_as_held(*plate.contact));
  BOOST_TEST(plate.contact->is_solution(plate.scene.fields));
  plate.slide(0.3);
  BOOST_TEST(!faces_as_held(*plate.contact));
  BOOST_TEST(!plate.contact->is_solution(plate.scene.fields));
  BOOST_TEST(!serves_again(*plate.contact, plate.scene.fields));
  plate.contact->begin_iteration(plate.scene.fields);
  plate.contact->hold_nodes_in_contact();
  BOOST_TEST(faces_as_held(*plate.contact));
  BOOST_TEST(plate.contact->is_solution(plate.scene.fields));
}

BOOST_AUTO_TEST_CASE(where_no_nodes_are_held_none_has_to_face_contact) {
  SlidingPlate plate;
  plate.contact->end_iterations();
  plate.slide(0.3);
  BOOST_TEST(faces_as_held(*plate.contact));
}

BOOST_AUTO_TEST_CASE(a_solution_has_nodes_that_changed_too_often_to_face_contact_tried_once_more) {
  SlidingPlate plate;
  plate.iterate(0.3);
  const std::ptrdiff_t there = plate.facing();
  const auto come_and_go = [&] {
    for (int change = 0; change <= ActiveSetOptions().most_status_changes; ++change)
      plate.iterate(change % 2 == 0 ? -0.3 : 0.3);
  };
  come_and_go();
  BOOST_TEST(plate.facing() < there);
  BOOST_TEST(faces_as_held(*plate.contact));
  BOOST_TEST(reconsiders_edge(*plate.contact, plate.scene.fields));
  plate.iterate(0);
  BOOST_TEST(plate.facing() == there);
  BOOST_TEST(!reconsiders_edge(*plate.contact, plate.scene.fields));
  come_and_go();
  BOOST_TEST(plate.facing() < there);
  BOOST_TEST(!reconsiders_edge(*plate.contact, plate.scene.fields));
}

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

  static constexpr std::ptrdiff_t column = 9;  ///< nodes of the larger plate that face the same share

  /// Opens an edge of the plate, such that shares of contact fall from x = 0.5 on, and begins a step. The last column
  /// that faces contact is at a share of a half.
  void open_edge() {
    contact->end_iterations();
    Matrix3Xd& position = scene.fields[Side::primary].position;
    for (Index node = 0; node < position.cols(); ++node) {
      if (position(0, node) > 0.9) position(2, node) -= 0.02;
    }
    iterate(0);
    contact->accept_step(scene.fields);
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

BOOST_AUTO_TEST_CASE(in_a_step_a_node_changes_only_if_its_share_passes_the_middle_by_a_margin) {
  SlidingPlate plate;
  plate.open_edge();
  const std::ptrdiff_t at_half = plate.facing();
  plate.iterate(-0.1);  // 0.3
  BOOST_TEST(plate.facing() == at_half);
  plate.iterate(-0.05);  // 0.2
  BOOST_TEST(plate.facing() == at_half - SlidingPlate::column);
  plate.iterate(0.05);  // the state decides, not how the iterations reached it
  BOOST_TEST(plate.facing() == at_half);
  plate.iterate(0.45);  // two columns have left on the other side, and one is at 0.7
  BOOST_TEST(plate.facing() == at_half - 2 * SlidingPlate::column);
  plate.iterate(0.05);  // 0.8
  BOOST_TEST(plate.facing() == at_half - SlidingPlate::column);
}

BOOST_AUTO_TEST_CASE(at_the_end_of_a_step_the_middle_decides) {
  SlidingPlate plate;
  plate.open_edge();
  const std::ptrdiff_t at_half = plate.facing();
  plate.iterate(-0.1);
  plate.contact->accept_step(plate.scene.fields);
  plate.iterate(0);
  BOOST_TEST(plate.facing() == at_half - SlidingPlate::column);
}

BOOST_AUTO_TEST_CASE(the_next_step_begins_with_the_nodes_that_faced_contact_in_the_last_one_also_after_a_restart) {
  SlidingPlate plate;
  plate.contact->accept_step(plate.scene.fields);
  const ContactInterface::State state = plate.contact->state();
  const NodeFlags facing = plate.contact->nodes_in_contact()[Side::secondary];
  BOOST_TEST((state.faced.front() == facing));
  const std::unique_ptr<ContactInterface> continued = plate.scene.contact();
  continued->restore(state);
  BOOST_TEST((continued->state().faced.front() == facing));
  ContactInterface::State wrong = state;
  wrong.faced.front().push_back(true);
  BOOST_CHECK_THROW(continued->restore(wrong), std::invalid_argument);
}

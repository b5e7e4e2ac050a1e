/// The arm of forces on back faces of rigid shells.
#pragma once

#include "contact_surfaces.h"

class FERigidBody;

/// Moves the nodes of rigid shells to the back face, where a contact has that, while an object of this type lives:
/// FEBio assembles a force on a node of a rigid body with the arm of the node's position.
class RigidShellBottoms {
 public:
  explicit RigidShellBottoms(ContactSurfaces& surfaces);
  RigidShellBottoms(const RigidShellBottoms&) = delete;
  RigidShellBottoms& operator=(const RigidShellBottoms&) = delete;
  RigidShellBottoms(RigidShellBottoms&&) = delete;
  RigidShellBottoms& operator=(RigidShellBottoms&&) = delete;
  ~RigidShellBottoms();

 private:
  struct Moved {
    FENode* node = nullptr;
    vec3d present;  ///< its own positions
    vec3d past;
  };
  void move_to_back(FENode& node, const FERigidBody& body);

  std::vector<Moved> moved_;
};

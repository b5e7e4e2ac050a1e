/// Moments of forces on the back faces of rigid shells.
#pragma once

#include "contact_surfaces.h"

class FERigidBody;

/// While an object of this class exists, the nodes of rigid shells are moved to those back faces that have a contact.
/// FEBio computes the moment of a force on a rigid body from the position of the node.
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
    vec3d present;  ///< original present position
    /// Original position at the start of the step.
    vec3d past;
  };
  void move_to_back(FENode& node, const FERigidBody& body);

  std::vector<Moved> moved_;
};

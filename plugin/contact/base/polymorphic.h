/// The base of classes with several implementations.
#pragma once

namespace mixture_contact {

/// An object that is used through its base class, and therefore not copied.
class Polymorphic {
 public:
  Polymorphic() = default;
  Polymorphic(const Polymorphic&) = delete;
  Polymorphic& operator=(const Polymorphic&) = delete;
  Polymorphic(Polymorphic&&) = delete;
  Polymorphic& operator=(Polymorphic&&) = delete;
  virtual ~Polymorphic() = default;
};

}  // namespace mixture_contact

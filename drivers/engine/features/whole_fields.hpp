#pragma once
// Access to the values of all nodes, for phases that need more than the nodes on which their features act.

namespace tread {

/// Fields whose values may live elsewhere, on a device. Between two phases of a step the views of the fields
/// hold those of nodes on which features act, and in measured steps all.
class WholeFields {
 public:
  /// Brings all values to the views.
  virtual void fetch() {}
  /// Takes over all values from the views, after fetch(): what they were elsewhere is no more.
  virtual void changed() {}
  /// True in steps in which tied nodes get their forces and motion where the values live.
  virtual bool ties_follow() const { return false; }

 protected:
  WholeFields() = default;
  ~WholeFields() = default;
};

}  // namespace tread

#pragma once
// The state that a run carries from one step to the next, as named views. Each owner lists its fields once;
// saving, restoring and comparing use that list.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/body_frame.hpp"
#include "core/math/vec.hpp"

namespace tread {

/// Views of the fields themselves, valid while their owners do not move or resize them.
class StateList {
 public:
  using Values = std::variant<std::span<double>, std::span<std::int64_t>, std::span<float>>;
  struct Field {
    std::string name;  ///< name such as "contact/frictional_work"
    Values values;
  };

  void add(const std::string& name, double& value) { add(name, std::span(&value, 1)); }
  void add(const std::string& name, std::int64_t& value) { add(name, std::span(&value, 1)); }
  void add(const std::string& name, Vec3& value) { add_records(name, std::span(&value, 1)); }
  void add(const std::string& name, BodyFrame& value) { add_records(name, std::span(&value, 1)); }
  void add(const std::string& name, Values values) { fields_.push_back({group_ + name, values}); }

  /// Adds plain structs of doubles.
  template <class Record>
  void add_records(const std::string& name, std::span<Record> records) {
    static_assert(std::is_trivially_copyable_v<Record> && std::is_standard_layout_v<Record> &&
                  alignof(Record) == alignof(double) && sizeof(Record) % sizeof(double) == 0);
    add(name, std::span(reinterpret_cast<double*>(records.data()),
                        records.size() * (sizeof(Record) / sizeof(double))));
  }

  /// Adds the fields of a part that has list_state(StateList&), under "name/".
  template <class Part>
  void add_part(const std::string& name, Part& part) {
    const std::string outer = std::exchange(group_, group_ + name + "/");
    part.list_state(*this);
    group_ = outer;
  }

  const std::vector<Field>& fields() const { return fields_; }
  /// The fields that another list does not have.
  StateList without(const StateList& other) const {
    StateList list;
    for (const Field& field : fields_)
      if (std::none_of(other.fields_.begin(), other.fields_.end(),
                       [&](const Field& left) { return left.name == field.name; }))
        list.fields_.push_back(field);
    return list;
  }

 private:
  std::vector<Field> fields_;
  std::string group_;
};

}  // namespace tread

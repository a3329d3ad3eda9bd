// The state of a settling run as bytes: every number that the next step depends on.
#pragma once

#include "engine/dem/force_field.h"

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace tamp {

/// Writes numbers and vectors of numbers one after the other, in the machine's own format.
class ByteWriter {
public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <int D>
  void put(const Vec<D>& v) {
    for (int a = 0; a < D; ++a)
      put(v[a]);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    for (const T& value : values)
      put_one(value);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
  void put_one(double value) { put(value); }
  template <int D>
  void put_one(const Eigen::Matrix<double, D, 1>& v) {
    put<D>(v);
  }
  std::string bytes_;
};

/// Reads them back; `good` turns false where the bytes end too early.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  void get(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      if (rest_.size() < sizeof value) {
        good = false;
        return;
      }
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.remove_prefix(sizeof value);
    } else {
      for (Eigen::Index a = 0; a < value.size(); ++a)
        get(value[a]);
    }
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::size_t n = 0;
    get(n);
    if (!good || n > rest_.size()) {
      good = false;
      return;
    }
    values.resize(n);
    for (T& value : values)
      get(value);
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  bool good = true;

private:
  std::string_view rest_;
};

/// Calls f(number or vector) for everything that a contact of this law remembers.
template <int D, class History, class F>
void for_each_memory(History& history, F&& f) {
  if constexpr (requires { history.touching; })
    f(history.touching);
  if constexpr (requires { history.slip; })
    f(history.slip);
  if constexpr (requires { history.roll; })
    f(history.roll);
}

template <int D, class Law, class LoadKind>
void write_state(ByteWriter& out, const State<D, Law>& s, const ForceField<D, Law, LoadKind>& field) {
  out.put(s.centre);
  out.put(s.velocity);
  out.put(s.force);
  out.put(s.mass);
  out.put(s.weight);
  if constexpr (Law::turns) {
    out.put(s.spin);
    out.put(s.torque);
  }
  if constexpr (ForceField<D, Law, LoadKind>::remembers) {
    const auto put_memory = [&](const auto& history) {
      for_each_memory<D>(history, [&](const auto& value) { out.put(value); });
    };
    out.put(field.near().pairs().size());
    for (std::size_t p = 0; p < field.near().pairs().size(); ++p) {
      const NearPair<D>& pair = field.near().pairs()[p];
      out.put(pair.i);
      out.put(pair.j);
      for (const std::int8_t turns : pair.image)
        out.put(turns);
      put_memory(field.memories().of_pair[p]);
    }
    out.put(field.near().walls().size());
    for (std::size_t w = 0; w < field.near().walls().size(); ++w) {
      const NearWall& wall = field.near().walls()[w];
      out.put(wall.i);
      out.put(wall.axis);
      out.put(wall.side);
      put_memory(field.memories().of_wall[w]);
    }
  }
}

/// Sets the state of as many spheres as `s` has; false if the bytes are of something else.
template <int D, class Law, class LoadKind>
bool read_state(ByteReader& in, State<D, Law>& s, ForceField<D, Law, LoadKind>& field) {
  const std::size_t n = s.count();
  in.get(s.centre);
  in.get(s.velocity);
  in.get(s.force);
  in.get(s.mass);
  in.get(s.weight);
  bool whole = s.centre.size() == n && s.velocity.size() == n && s.force.size() == n && s.mass.size() == n &&
               s.weight.size() == n;
  if constexpr (Law::turns) {
    in.get(s.spin);
    in.get(s.torque);
    whole = whole && s.spin.size() == n && s.torque.size() == n;
  }
  if (!in.good || !whole)
    return false;
  std::vector<NearPair<D>> pairs;
  std::vector<NearWall> walls;
  Memories<D, Law> memories;
  if constexpr (ForceField<D, Law, LoadKind>::remembers) {
    const auto get_memory = [&](auto& histories) {
      histories.emplace_back();
      for_each_memory<D>(histories.back(), [&](auto& value) { in.get(value); });
    };
    std::size_t count = 0;
    in.get(count);
    for (std::size_t p = 0; in.good && p < count; ++p) {
      NearPair<D>& pair = pairs.emplace_back();
      in.get(pair.i);
      in.get(pair.j);
      for (std::int8_t& turns : pair.image)
        in.get(turns);
      get_memory(memories.of_pair);
    }
    in.get(count);
    for (std::size_t w = 0; in.good && w < count; ++w) {
      NearWall& wall = walls.emplace_back();
      in.get(wall.i);
      in.get(wall.axis);
      in.get(wall.side);
      get_memory(memories.of_wall);
    }
  }
  if (!in.good || !in.at_end())
    return false;
  field.restore(s, pairs, walls, std::move(memories));
  return true;
}

} // namespace tamp

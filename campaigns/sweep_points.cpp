// Multiplies blocks out, evaluates expressions and conditions point by point.
#include "campaigns/sweep_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace tamp {

namespace {

constexpr std::string_view kScene = "scene/";

/// Number of points before conditions, or nothing if there are more than `most`.
std::optional<std::size_t> count_points(const std::vector<SweepBlock>& sweep, std::size_t most) {
  std::size_t sum = 0;
  for (const SweepBlock& block : sweep) {
    std::size_t product = 1;
    for (const Axis& axis : block.axes) {
      product *= axis.size(); // both factors are far below 2^32
      if (product > most)
        return std::nullopt;
    }
    sum += product + block.include.size();
    if (sum > most)
      return std::nullopt;
  }
  return sum;
}

/// The points of one block, without conditions.
std::vector<SweepPoint> points_of(const SweepBlock& block) {
  std::vector<SweepPoint> points;
  if (!block.axes.empty() || block.include.empty())
    points.push_back({{}, &block, false, {}});
  for (const Axis& axis : block.axes) {
    std::vector<SweepPoint> longer;
    for (const SweepPoint& point : points) {
      for (const Step& step : axis) {
        longer.push_back(point);
        longer.back().steps.push_back(&step);
      }
    }
    points = std::move(longer);
  }
  for (const Step& step : block.include)
    points.push_back({{&step}, &block, true, {}});
  return points;
}

/// A derived value as it is kept: to twelve digits, as the last ones of exp and log differ between machines, and a job
/// must have one key on all.
double settled(double value) {
  const std::string digits = fmt::format("{:.11e}", value);
  double out = value;
  std::from_chars(digits.data(), digits.data() + digits.size(), out);
  return out;
}

/// What arithmetic sees of a value: a number, or a list of one.
std::optional<double> number_in(const JsonLeaf& leaf) {
  if (const auto* number = std::get_if<double>(&leaf))
    return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&leaf))
    return static_cast<double>(*whole);
  const auto* list = std::get_if<std::vector<double>>(&leaf);
  return list != nullptr && list->size() == 1 ? std::optional(list->front()) : std::nullopt;
}

/// A number as a leaf of the rule's kind; nothing if the rule does not allow it.
std::optional<JsonLeaf> leaf_of(double value, const ValueRule& rule) {
  constexpr double largest = 0x1.0p53; // beyond, doubles skip whole numbers
  if (!std::isfinite(value) || !rule.range.holds(value))
    return std::nullopt;
  if (rule.kind == ParameterKind::number)
    return value;
  if (rule.kind == ParameterKind::numbers)
    return std::vector<double>{value};
  if (std::trunc(value) != value || !(std::abs(value) <= largest))
    return std::nullopt;
  return static_cast<std::int64_t>(value);
}

class Sweeper {
public:
  Sweeper(const CampaignFile& file, Mistakes& mistakes) : file_(file), mistakes_(mistakes) {}

  SweepPoints sweep() {
    if (file_.sweep.empty())
      out_.points.push_back({{}, nullptr, false, std::vector<bool>(file_.methods.size(), true)});
    for (const SweepBlock& block : file_.sweep)
      add(block);
    if (out_.points.empty() && mistakes_.count() == 0)
      mistakes_.add({file_.sweep.front().place, "\"when\" and \"exclude\" leave nothing of the sweep",
                     "at least one point and method", ""});
    return std::move(out_);
  }

private:
  void add(const SweepBlock& block) {
    std::vector<SweepPoint> points = points_of(block);
    for (const Derivation& derivation : block.derived)
      derive(derivation, points);
    for (SweepPoint& point : points)
      point.methods.assign(file_.methods.size(), true);
    if (block.when)
      keep(*block.when, points);
    for (const Condition& condition : block.exclude)
      leave_out(condition, points);
    for (SweepPoint& point : points) {
      if (std::find(point.methods.begin(), point.methods.end(), true) != point.methods.end())
        out_.points.push_back(std::move(point));
    }
  }

  /// The value of a scene's, run's or swept path at a point; nothing if there is none.
  [[nodiscard]] std::optional<JsonLeaf> value_at(const SweepPoint& point, const std::string& path) const {
    if (const Statement* statement = find_statement(point, path))
      return statement->leaf;
    if (const auto* row = find_row(repeat_parameters(), path))
      return row->get(file_.repeats);
    if (!path.starts_with(kScene))
      return std::nullopt;
    for (const Statement& statement : file_.scene) {
      if (statement.path == path)
        return statement.leaf;
    }
    const auto* row = find_row(scene_parameters(), std::string_view(path).substr(kScene.size()));
    JsonLeaf leaf = row->get(Scene{});
    return is_unstated(leaf) ? std::nullopt : std::optional(std::move(leaf));
  }

  void derive(const Derivation& derivation, std::vector<SweepPoint>& points) {
    const ValueRule rule = *sweep_rule(derivation.path);
    bool told = false;
    const auto refuse = [&](const std::string& what, const SweepPoint& point, const std::string& allowed) {
      if (!std::exchange(told, true))
        mistakes_.add({derivation.place, fmt::format("{} (at the point {})", what, point_words(point)), allowed, ""});
    };
    for (SweepPoint& point : points) {
      if (find_statement(point, derivation.path) != nullptr)
        continue; // an included point may state the value itself
      Statement statement{derivation.path, std::nullopt, nullptr, "", derivation.place, derivation.group};
      std::vector<double> values;
      for (const Expression::Name& name : derivation.expression.names()) {
        std::string path = name.text;
        std::replace(path.begin(), path.end(), '.', '/');
        const auto leaf = value_at(point, path);
        const auto number = leaf ? number_in(*leaf) : std::nullopt;
        if (!number) {
          refuse(fmt::format("{} has no value that is one number", name.text), point, "");
          break;
        }
        values.push_back(*number);
      }
      if (values.size() == derivation.expression.names().size()) {
        const double value = settled(derivation.expression.value(values));
        statement.leaf = leaf_of(value, rule);
        if (statement.leaf)
          statement.words = leaf_words(*statement.leaf);
        else
          refuse(fmt::format("the expression gives {}", value), point, rule.allowed());
      }
      out_.derived.push_back({derivation.place, {std::move(statement)}});
      point.steps.push_back(&out_.derived.back());
    }
  }

  [[nodiscard]] bool holds(const Condition& condition, const SweepPoint& point, const MethodEntry& entry) const {
    const auto called = [&](const std::string& name) {
      return name == entry.label || name == name_of(entry.method.name);
    };
    if (!condition.methods.empty() && std::none_of(condition.methods.begin(), condition.methods.end(), called))
      return false;
    return std::all_of(condition.values.begin(), condition.values.end(), [&](const auto& wanted) {
      const auto& [path, allowed] = wanted;
      std::optional<JsonLeaf> value = value_at(point, path);
      if (path.starts_with("method/")) {
        const auto* row = method_row(path, entry.method);
        if (row == nullptr)
          return false;
        if (!value)
          value = row->get(entry.method);
      }
      return value && std::find(allowed.begin(), allowed.end(), *value) != allowed.end();
    });
  }

  /// Keeps what the condition asks for, and the packings which that starts from.
  void keep(const Condition& condition, std::vector<SweepPoint>& points) {
    bool ever = false;
    for (SweepPoint& point : points) {
      for (std::size_t m = file_.methods.size(); m-- > 0;) {
        bool needed = false;
        for (std::size_t child = m + 1; child < file_.methods.size(); ++child)
          needed = needed || (point.methods[child] && file_.methods[child].from == m);
        point.methods[m] = needed || holds(condition, point, file_.methods[m]);
        ever = ever || point.methods[m];
      }
    }
    tell_unless(ever, condition);
  }

  /// Leaves out what the condition names, and what starts from those packings.
  void leave_out(const Condition& condition, std::vector<SweepPoint>& points) {
    bool ever = false;
    for (SweepPoint& point : points) {
      if (point.included)
        continue;
      for (std::size_t m = 0; m < file_.methods.size(); ++m) {
        const MethodEntry& entry = file_.methods[m];
        const bool out = holds(condition, point, entry);
        ever = ever || out;
        if (out || (entry.from && !point.methods[*entry.from]))
          point.methods[m] = false;
      }
    }
    tell_unless(ever, condition);
  }

  void tell_unless(bool ever, const Condition& condition) {
    if (!ever && mistakes_.count() == 0)
      mistakes_.add(
          {condition.place, "the condition holds nowhere", "values and methods that occur in this block", ""});
  }

  const CampaignFile& file_;
  Mistakes& mistakes_;
  SweepPoints out_;
};

} // namespace

std::optional<SweepPoints> sweep_points(const CampaignFile& file, std::size_t most, Mistakes& mistakes) {
  if (!count_points(file.sweep, most))
    return std::nullopt;
  return Sweeper(file, mistakes).sweep();
}

const Statement* find_statement(const SweepPoint& point, std::string_view path) {
  for (const Step* step : point.steps) {
    for (const Statement& statement : step->statements) {
      if (statement.path == path)
        return &statement;
    }
  }
  return nullptr;
}

const Parameter<Method>* method_row(std::string_view path, const Method& method) {
  constexpr std::string_view root = "method/";
  if (!path.starts_with(root))
    return nullptr;
  const auto* row = find_row(method_parameters(), path.substr(root.size()));
  return row != nullptr && row->applies(method) ? row : nullptr;
}

} // namespace tamp

// Where and for how long another program works: the job's folder, which stays, or one that goes when the work is done.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace tamp {

/// The seconds that another program has of those of a job: the rest is for reading and keeping what it made.
class Deadline {
public:
  /// `wall_s` from now; 0: no end.
  explicit Deadline(double wall_s);

  /// Seconds left, 0 if there is no end.
  [[nodiscard]] double left() const;
  /// Whether there is less left than a start of another program is worth.
  [[nodiscard]] bool over() const;
  /// What is said of a job that ended so.
  [[nodiscard]] std::string reason() const;

private:
  double wall_s_;
  double allowed_s_;
  std::chrono::steady_clock::time_point start_;
};

class WorkFolder {
public:
  /// Makes `wanted`, emptied if it was there; without a name a folder for temporary files. Throws Error.
  explicit WorkFolder(const std::filesystem::path& wanted);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Leaves scripts, logs and tables, which are small, and removes the places of spheres, which the packing has.
  void tidy() const;
  void remove() const noexcept;

private:
  std::filesystem::path path_;
  bool passing_;
};

} // namespace tamp

// Prepared statements, kept between uses, and one use of such a statement.
#pragma once

#include "engine/base/error.h"
#include "engine/model/enum_names.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace tamp {

/// The prepared statements of one connection. Not for several threads at once.
class Statements {
public:
  explicit Statements(SQLite::Database& database) : database_(database) {}

  SQLite::Statement& get(std::string_view sql) {
    if (const auto found = prepared_.find(sql); found != prepared_.end())
      return found->second;
    const std::string text(sql);
    return prepared_.emplace(text, SQLite::Statement(database_, text)).first->second;
  }

  [[nodiscard]] SQLite::Database& database() const { return database_; }

private:
  SQLite::Database& database_;
  std::map<std::string, SQLite::Statement, std::less<>> prepared_;
};

/// One use of a statement: values for its ?, in order, then rows. Ends the statement when it goes, as an unfinished one
/// would keep its view of the database open for ever. Two uses of the same SQL must not overlap.
class Query {
public:
  template <class... Values>
  Query(Statements& statements, std::string_view sql, const Values&... values) : statement_(statements.get(sql)) {
    (bind(values), ...);
  }
  ~Query() {
    statement_.tryReset();
    statement_.clearBindings();
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  /// Goes to the next row; false after the last. Statements without rows are carried out by one call.
  bool step() { return statement_.executeStep(); }

  [[nodiscard]] std::string text(int column) const { return statement_.getColumn(column).getString(); }
  [[nodiscard]] std::int64_t integer(int column) const { return statement_.getColumn(column).getInt64(); }
  [[nodiscard]] double number(int column) const { return statement_.getColumn(column).getDouble(); }

private:
  void bind(std::string_view value) { statement_.bind(++bound_, std::string(value)); }
  void bind(std::int64_t value) { statement_.bind(++bound_, value); }
  void bind(double value) { statement_.bind(++bound_, value); }

  SQLite::Statement& statement_;
  int bound_ = 0;
};

/// The value that a column holds by its name; throws Error for a name that this tamp does not know.
template <class E>
E enum_from_row(const std::string& text, std::string_view column) {
  if (const auto value = enum_of<E>(text))
    return *value;
  throw Error(fmt::format("the column {} holds \"{}\", which this tamp does not know", column, text));
}

} // namespace tamp

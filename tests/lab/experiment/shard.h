#pragma once
/// Shards of a table: its rows dealt out to processes that know nothing of each other.

#include <cstddef>
#include <string>
#include <vector>

#include "tests/lab/experiment/experiment.h"

namespace seam {

/// Returns the shard of a row, from 0 to `count` - 1: FNV-1a of its key, modulo `count`. Of the
/// key, version, commit and numerics do not count, and of the scene only the file's name.
/// `columns`: the names of the key's columns.
std::size_t ShardOf(const std::vector<std::string>& columns, const std::string& key,
                    std::size_t count);

struct Shard {
  std::size_t index = 0, count = 1;
};
/// Reads "3/8": the fourth of eight. Throws OperatorError.
Shard ParseShard(const std::string& text);

/// Returns the same experiment with these rows alone, in ascending order.
Experiment WithRows(const Experiment& experiment, const std::vector<std::size_t>& rows);

/// Completes the table, or with --shard one shard of it in the folder of --output, without the rows
/// that the tables of --have hold; its own table does not count among them. Returns the exit
/// status. `name`: of the whole table, "demo" for "demo.3-of-8.csv".
int CompleteShard(const Experiment& experiment, const TableFlags& flags, const std::string& name);

}  // namespace seam

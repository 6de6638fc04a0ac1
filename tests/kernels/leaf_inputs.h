// Random inputs of leaf functions, by the types and names of their parameters.
//
// leaf_inputs.cpp has one table: how what bears a name is drawn. Without a row a number is any number, a word any word,
// and a struct is drawn field by field. So a new leaf needs no row, or one for a name with a meaning of its own.
#pragma once

#include "tests/kernels/draw.h"
#include "tests/kernels/leaf_probes.h"
#include "tests/kernels/leaf_scenes.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hyalite::core::testing {

struct Situation;

class LeafInputs {
  public:
    LeafInputs(const LeafProbe &probe, const LeafScene &scene);
    ~LeafInputs();

    /// Appends one input.
    void draw(Words &words);

  private:
    using Row = std::function<void(Situation &, Words &)>;

    std::unique_ptr<Situation> situation_;
    std::vector<Row> rows_;
};

/// Names in the table that no parameter of any leaf bears.
[[nodiscard]] std::vector<std::string> unusedInputRows();

} // namespace hyalite::core::testing

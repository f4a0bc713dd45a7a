#pragma once
// Memory that a filter needs while it works, kept by the thread for the next call: given back to the system and taken again, its
// pages would cost a short signal more than its arithmetic.

#include <cstddef>
#include <memory>
#include <vector>

namespace circlepoint::detail {

class Scratch {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    if (needed_ > kept().size() && needed_ <= most_kept) {
      kept() = std::vector<double>(needed_);
    }
  }

  /// `count` values yet to be written, until the end of this object. One object a thread at a time.
  double* take(std::size_t count) {
    const std::size_t begin = needed_;
    needed_ += (count + 7) / 8 * 8;
    if (needed_ <= kept().size()) {
      return kept().data() + begin;
    }
    more_.emplace_back(new double[count]);
    return more_.back().get();
  }

 private:
  static constexpr std::size_t most_kept = std::size_t{1} << 20U;  // 8 MB
  std::size_t needed_ = 0;
  std::vector<std::unique_ptr<double[]>> more_;

  static std::vector<double>& kept() {
    thread_local std::vector<double> values;
    return values;
  }
};

}  // namespace circlepoint::detail

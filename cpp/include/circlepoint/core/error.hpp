#pragma once
// Errors. A message says what was wrong, the value, where (row, joint, time) and what to do about it.
// A poor fit is not an error: it is a result with its covariance.

#include <stdexcept>
#include <string>

namespace circlepoint {

/// Base of every error this library raises on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's data or arguments cannot be used as they are (a ValueError in Python).
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// The data are well formed but do not determine the parameter asked for.
class NotIdentifiable : public Error {
 public:
  using Error::Error;
};

/// An iteration ended without reaching its tolerance.
class DidNotConverge : public Error {
 public:
  using Error::Error;
};

/// Raises InvalidInput unless the condition holds.
inline void require(bool condition, const std::string& message) {
  if (!condition) {
    throw InvalidInput(message);
  }
}

}  // namespace circlepoint

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

/// The text of the error that an action throws, which must have this code; "no error" if it throws none.
template <class Action>
std::string error_of(const Action& action, ExitCode code) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "no error";
}

}  // namespace mesogen

#pragma once
// The message of the exception that a call is expected to throw.

#include <string>

#include <gtest/gtest.h>

namespace carom {

template <typename Exception, typename Call>
std::string thrownMessage(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << "another exception: " << other.what();
    return "";
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace carom

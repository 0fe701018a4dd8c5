// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ErrorOf_h
#define freespace_ErrorOf_h

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace freespace
{

/// The message of the Error that an action throws; empty where it throws none.
inline std::string ErrorOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

/// Expects an Error whose message has all of these words.
inline void ExpectError(const std::function<void()>& action, const std::vector<std::string>& words)
{
  const std::string message = ErrorOf(action);
  ASSERT_FALSE(message.empty()) << "no error";
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  }
}

}

#endif

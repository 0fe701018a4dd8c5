// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NumberValidators_h
#define freespace_NumberValidators_h

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace freespace
{

/// The finite numbers of a text, separated by commas; empty if it contains anything else.
std::vector<double> NumbersOf(const std::string& text);

/// Accepts a finite number of 0 or more. CLI11's own NonNegativeNumber accepts NaN and prints its limits
/// with 309 digits.
CLI::Validator NonNegative();

/// From `least` to `most`; unlike CLI::Range it refuses nan.
CLI::Validator Between(double least, double most);

/// The same for a number above 0.
CLI::Validator Positive();

/// A whole number in decimal digits; CLI::Range also takes 0x10.
CLI::Validator WholeNumber(int least, int most);

}

#endif

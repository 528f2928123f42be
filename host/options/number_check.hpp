// SPDX-License-Identifier: Apache-2.0
// Checks of numbers on the command line. CLI::Range accepts nan, and writes limits with up to 309 digits.
#pragma once

namespace CLI {
class Validator;
}

namespace tandem::options {

/// Returns a check that the value of an option is a number from `min` to `max`.
CLI::Validator number_between(double min, double max);

/// Returns a check that the value of an option is a finite number above 0.
CLI::Validator positive_number();

/// Returns a check that the value of an option is a finite number, 0 or above.
CLI::Validator nonnegative_number();

} // namespace tandem::options

// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/method_type.hpp"

namespace tandem::adaptor {
namespace {

using Doubles = std::vector<double>;
using TwoArgumentResults = WithResults<void, bool, int, double, std::string, Doubles, std::vector<int>>;

template <class First, class... Second>
void add_each_second(MethodTypes& types) {
    (TwoArgumentResults::add<First, Second>(types), ...);
}

template <class... First>
void add_each_first(MethodTypes& types) {
    (add_each_second<First, int, double, std::string, Doubles>(types), ...);
}

} // namespace

void add_methods_of_two_arguments(MethodTypes& types) {
    add_each_first<int, double, std::string, Doubles>(types);
}

} // namespace tandem::adaptor

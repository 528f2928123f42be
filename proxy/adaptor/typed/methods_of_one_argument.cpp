// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/method_type.hpp"

namespace tandem::adaptor {
namespace {

using Doubles = std::vector<double>;
using OneArgumentResults =
    WithResults<void, bool, int, long long, float, double, std::string, Doubles, std::vector<int>>;

template <class... P>
void add_each(MethodTypes& types) {
    (OneArgumentResults::add<P>(types), ...);
}

} // namespace

void add_methods_of_one_argument(MethodTypes& types) {
    OneArgumentResults::add<>(types);
    add_each<bool, int, long long, float, double, std::string, Doubles, std::vector<int>>(types);
}

} // namespace tandem::adaptor

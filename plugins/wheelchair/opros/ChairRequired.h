// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include "IChair.h"

/// Required port of service IChair. Calls throw MethodInvokeException if nothing is connected or the provider fails.
class ChairRequired : public RequiredServicePort, public IChair {
  public:
    ChairRequired() {
        parameters_ = add<std::vector<double>>("parameters",
                                               makeRequiredMethod(&ChairRequired::parameters, "parameters"));
        limits_ = add<std::vector<double>>("limits", makeRequiredMethod(&ChairRequired::limits, "limits"));
        emergency_stop_ =
            add<bool>("emergency_stop", makeRequiredMethod(&ChairRequired::emergency_stop, "emergency_stop"));
    }

    std::vector<double> parameters() override { return (*parameters_)(); }
    std::vector<double> limits() override { return (*limits_)(); }
    bool emergency_stop() override { return (*emergency_stop_)(); }

  private:
    template <class Result>
    RequiredMethod<Result>* add(const char* name, Method* method) {
        addMethod(name, method);
        return reinterpret_cast<RequiredMethod<Result>*>(method);
    }

    RequiredMethod<std::vector<double>>* parameters_;
    RequiredMethod<std::vector<double>>* limits_;
    RequiredMethod<bool>* emergency_stop_;
};

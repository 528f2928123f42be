// SPDX-License-Identifier: Apache-2.0
// The service that SurveyComp requires, in the style of generated code.
#pragma once

#include "SurveyTypes.h"

#include <RequiredMethod.h>
#include <RequiredServicePort.h>

class SurveyorRequired : public RequiredServicePort {
  public:
    SurveyorRequired() {
        Method* move = makeRequiredMethod(&SurveyorRequired::move, "move");
        addMethod("move", move);
        move_ = reinterpret_cast<MoveType*>(move);
    }
    std::vector<Mark> move(std::vector<Mark> from, double dx) { return (*move_)(from, dx); }

  private:
    typedef RequiredMethod<std::vector<Mark>> MoveType;
    MoveType* move_;
};

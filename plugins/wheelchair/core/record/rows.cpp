// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/rows.hpp"

#include <charconv>
#include <cmath>

#include "plugins/wheelchair/core/body/hw_body.hpp"
#include "plugins/wheelchair/core/law/control_law.hpp"
#include "plugins/wheelchair/core/law/joystick_law.hpp"
#include "plugins/wheelchair/core/plant/chair.hpp"
#include "plugins/wheelchair/core/plant/steering.hpp"

namespace tandem::wheelchair {

namespace {

// Column names of docs/wheelchair.md, section 11, which other programs read.
constexpr const char* heading_line = "t,jx,jy,ref_dir_deg,ref_speed,dir_filt_deg,steer_meas_deg,steer_true_"
                                     "deg,wL_meas,wR_meas,wL,wR,uL,uR,iL,iR,x,y,"
                                     "theta,phiL_deg,phiR_deg,brake,state\n";

/// Returns a row with HWComp's columns; the others are 0.
Row make_row(const HWRecord& h) {
    Row r;
    r.t = h.sequence * tick_seconds;
    r.jx = std::lround(h.jx);
    r.jy = std::lround(h.jy);
    r.steering_measured_deg = steering_angle_deg(h.wheel_left_measured, h.wheel_right_measured);
    r.steering_true_deg = steering_angle_deg(h.wheel_left, h.wheel_right);
    r.wheel_left_measured = h.wheel_left_measured;
    r.wheel_right_measured = h.wheel_right_measured;
    r.wheel_left = h.wheel_left;
    r.wheel_right = h.wheel_right;
    r.current_left = h.current_left;
    r.current_right = h.current_right;
    r.x = h.x;
    r.y = h.y;
    r.heading = h.heading;
    r.caster_left_deg = h.caster_left * degrees;
    r.caster_right_deg = h.caster_right * degrees;
    return r;
}

void add(Row& row, const JoystickRecord& j) {
    row.reference_direction_deg = j.direction_deg;
    row.reference_speed = j.speed;
}

void add(Row& row, const ControlRecord& c) {
    row.filtered_direction_deg = c.filtered_direction_deg;
    row.volts_left = c.volts_left;
    row.volts_right = c.volts_right;
    row.brake = std::lround(c.brake);
    row.state = std::lround(c.state);
}

// Returns the sequence number of HWComp's publication that the component used in that tick.
double used_sequence(const JoystickRecord& j) { return j.position_sequence; }
double used_sequence(const ControlRecord& c) { return c.wheel_sequence; }

/// Finds the record for each publication of HWComp, for publications in ascending order.
template <class Record>
class RecordMatcher {
  public:
    explicit RecordMatcher(const std::vector<Record>& records) : records_(records) {}

    /// Returns the record of the tick that used publication `h`; otherwise the last one found, or null.
    const Record* at(const HWRecord& h) {
        while (next_ < records_.size() &&
               (records_[next_].at < h.at || used_sequence(records_[next_]) < h.sequence))
            ++next_;
        if (next_ < records_.size() && used_sequence(records_[next_]) == h.sequence) last_ = &records_[next_];
        return last_;
    }

  private:
    const std::vector<Record>& records_;
    std::size_t next_ = 0;
    const Record* last_ = nullptr;
};

// A restarted HWComp continues the trace file with sequence number 0.
std::size_t last_start(const std::vector<HWRecord>& hw) {
    for (std::size_t i = hw.size(); i-- > 0;)
        if (hw[i].sequence == 0.0) return i;
    return 0;
}

/// Builds lines of CSV.
class CsvText {
  public:
    // The limit gives -0 and rounding noise of different builds the same text.
    void number(double x) { print(std::abs(x) >= 1e-12 ? x : 0.0, std::chars_format::general, 7); }
    void number(long x) { print(x); }
    void end_line() { text_.back() = '\n'; }
    std::string text_;

  private:
    // std::to_chars() ignores the locale, unlike snprintf().
    template <class... Value>
    void print(Value... value) {
        char buffer[40];
        text_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value...).ptr);
        text_ += ',';
    }
};

} // namespace

std::vector<Row> simulate(const Scenario& scenario) {
    Chair chair(scenario, 0.0);
    JoystickParameters parameters;
    parameters.direction_rate = scenario.direction_rate;
    JoystickLaw joystick(parameters);
    ControlLaw control;
    Stamped<Reference> sent;
    std::vector<Row> rows;
    // The order of docs/wheelchair.md, section 5.1: joystick, control, the row, then the chair.
    for (int n = 0; n <= scenario.last_tick(); ++n) {
        const double t = n * tick_seconds, tick = n;
        const auto reference = joystick.tick(chair.joystick());
        if (!scenario.muted(t)) sent = {t, tick, reference};
        const auto voltage = control.tick(t, sent, {t, tick, chair.wheel_speed()});
        Row row = make_row(make_record(chair));
        row.reference_direction_deg = reference.direction_deg;
        row.reference_speed = reference.speed;
        row.filtered_direction_deg = control.filtered_direction_deg();
        row.volts_left = voltage.left;
        row.volts_right = voltage.right;
        row.brake = voltage.brake;
        row.state = static_cast<long>(control.state());
        rows.push_back(row);
        chair.apply(t, Stamped<Voltage>{t, tick, voltage}, false);
        chair.advance();
    }
    return rows;
}

std::vector<Row> merge(const std::vector<HWRecord>& hw, const std::vector<JoystickRecord>& joystick,
                       const std::vector<ControlRecord>& control, int last_tick) {
    RecordMatcher<JoystickRecord> references(joystick);
    RecordMatcher<ControlRecord> voltages(control);
    std::vector<Row> rows;
    for (std::size_t i = last_start(hw); i < hw.size() && hw[i].sequence <= last_tick; ++i) {
        Row row = make_row(hw[i]);
        if (const auto* j = references.at(hw[i])) add(row, *j);
        if (const auto* c = voltages.at(hw[i])) add(row, *c);
        rows.push_back(row);
    }
    return rows;
}

std::string csv_text(const std::vector<Row>& rows) {
    CsvText out;
    out.text_ = heading_line;
    for (const Row& r : rows) {
        out.number(r.t);
        out.number(r.jx);
        out.number(r.jy);
        for (double x :
             {r.reference_direction_deg, r.reference_speed, r.filtered_direction_deg, r.steering_measured_deg,
              r.steering_true_deg, r.wheel_left_measured, r.wheel_right_measured, r.wheel_left, r.wheel_right,
              r.volts_left, r.volts_right, r.current_left, r.current_right, r.x, r.y, r.heading,
              r.caster_left_deg, r.caster_right_deg})
            out.number(x);
        out.number(r.brake);
        out.number(r.state);
        out.end_line();
    }
    return out.text_;
}

} // namespace tandem::wheelchair

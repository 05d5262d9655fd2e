// Reference solution of the rocking problem in quadruple precision, by another formulation than the program's own:
// Taylor series of phi = alpha - |theta| of order 20 in each interval between samples, events by scanning and bisection.
// Built and run by rocking.py beside it. Reads from stdin
//     number of structures, then p alpha eta each (as hexadecimal floating-point numbers);
//     number of motions, then id dt n and n samples each (likewise)
// and writes a CSV of the responses to stdout.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <quadmath.h>
#include <string>
#include <vector>

using Real = __float128;
const int ORDER = 20, PIECES = 16;
const Real G = Real(981) / 100, HALF_PI = M_PIq / 2, REST_VELOCITY = Real(1) / 1000000;
enum Phase { REST, ROCKING, OVERTURNED };

struct Structure { Real p, alpha, eta; };
struct Response { std::string outcome; Real edp; long impacts; };

struct Series {
    Real c[ORDER + 1];
    Real value(Real x) const { Real s = 0; for (int k = ORDER; k >= 0; --k) s = s * x + c[k]; return s; }
    // No rotation within x differs by more from that at the start.
    Real reach(Real x) const { Real s = 0; for (int k = ORDER; k >= 1; --k) s = (s + fabsq(c[k])) * x; return s; }
    Real slope(Real x) const { Real s = 0; for (int k = ORDER; k >= 1; --k) s = s * x + k * c[k]; return s; }
};

// r = |theta| over a step, from phi'' = sin phi + (w0 + w1 x) cos phi in x = p t.
Series taylor(Real alpha, Real r, Real v, Real w0, Real w1) {
    Real f[ORDER + 1] = {alpha - r, -v}, s[ORDER + 1], c[ORDER + 1];
    s[0] = sinq(f[0]);
    c[0] = cosq(f[0]);
    for (int k = 0; k + 2 <= ORDER; ++k) {
        if (k > 0) {
            s[k] = c[k] = 0;
            for (int j = 1; j <= k; ++j) { s[k] += j * f[j] * c[k - j]; c[k] -= j * f[j] * s[k - j]; }
            s[k] /= k;
            c[k] /= k;
        }
        f[k + 2] = (s[k] + w0 * c[k] + (k ? w1 * c[k - 1] : Real(0))) / ((k + 1) * (k + 2));
    }
    Series series;
    for (int k = 0; k <= ORDER; ++k) series.c[k] = -f[k];
    series.c[0] = r;
    return series;
}

template <class F> Real bisect(F f, Real low, Real high) {
    bool positive = f(low) > 0;
    for (int k = 0; k < 130; ++k) {
        Real middle = (low + high) / 2;
        ((f(middle) > 0) == positive ? low : high) = middle;
    }
    return (low + high) / 2;
}

// The first x in (0, h] at which f, positive after 0, is no longer so; or a negative number.
template <class F, class D> Real first_root(F f, D derivative, Real h) {
    for (int piece = 0; piece < PIECES; ++piece) {
        Real low = h * piece / PIECES, high = h * (piece + 1) / PIECES;
        if (f(high) <= 0) return bisect(f, low, high);
        if (derivative(low) < 0 && derivative(high) > 0) {
            Real least = bisect([&](Real x) { return -derivative(x); }, low, high);
            if (f(least) <= 0) return bisect(f, low, least);
        }
    }
    return -1;
}

Response simulate(const Structure &structure, Real dt, const std::vector<Real> &u) {
    const Real p = structure.p, alpha = structure.alpha, eta = structure.eta, tangent = tanq(alpha);
    Phase phase = REST;
    Real side = 0, r = 0, v = 0, peak = 0;
    bool rocked = false, at_threshold = false;
    long impacts = 0;
    for (size_t i = 0; i + 1 < u.size() && phase != OVERTURNED; ++i) {
        const Real slope = (u[i + 1] - u[i]) / (p * dt), end = p * dt;
        Real x = 0;
        auto ground = [&](Real at) { return u[i] + slope * at; };
        while (x < end && phase != OVERTURNED) {
            if (phase == REST) {
                Real now = ground(x);
                if (fabsq(now) < tangent) {
                    if (fabsq(u[i + 1]) <= tangent) break;
                    Real threshold = u[i + 1] > 0 ? tangent : -tangent;
                    x = (threshold - u[i]) / slope;
                    now = threshold;
                    at_threshold = true;
                } else if (fabsq(now) == tangent && fabsq(u[i + 1]) <= tangent) {
                    break;
                }
                side = now > 0 ? -1 : 1;
                r = v = 0;
                phase = ROCKING;
                rocked = true;
            }
            Real h = fminq(end - x, Real(2) / 100 / sqrtq(1 + fmaxq(fabsq(u[i]), fabsq(u[i + 1]))));
            Series series = taylor(alpha, r, v, side * ground(x), side * slope);
            // Where uplift begins at its threshold nothing but rounding accelerates the structure yet.
            if (at_threshold) series.c[2] = 0;
            at_threshold = false;
            // From the base, the root at the start does not count.
            bool based = r == 0;
            auto rotation = [&](Real t) {
                return based ? (t == 0 ? (v > 0 ? v : series.value(h / 1000000)) : series.value(t) / t) : series.value(t);
            };
            auto change = [&](Real t) {
                return based ? (t == 0 ? series.c[2] : (series.slope(t) - series.value(t) / t) / t) : series.slope(t);
            };
            const Real reach = series.reach(h);
            Real impact = r > reach ? Real(-1) : first_root(rotation, change, h);
            Real until = impact < 0 ? h : impact;
            auto margin = [&](Real t) { return HALF_PI - series.value(t); };
            if (r + reach >= HALF_PI && first_root(margin, [&](Real t) { return -series.slope(t); }, until) >= 0) {
                phase = OVERTURNED;
                break;
            }
            for (int piece = 0; piece < PIECES && r + reach > peak; ++piece) {
                Real low = until * piece / PIECES, high = until * (piece + 1) / PIECES;
                peak = fmaxq(peak, series.value(high));
                if (series.slope(low) > 0 && series.slope(high) <= 0)
                    peak = fmaxq(peak, series.value(bisect([&](Real t) { return series.slope(t); }, low, high)));
            }
            r = series.value(until);
            v = series.slope(until);
            x = until == end - x ? end : x + until;
            if (impact >= 0) {
                ++impacts;
                r = 0;
                v = -eta * v;
                side = -side;
                if (v < REST_VELOCITY) phase = REST;
            }
        }
    }
    // After the record: v^2/2 + cos(alpha - r) is constant between impacts.
    if (phase == ROCKING) {
        Real energy = v * v / 2 + cosq(alpha - r);
        bool outwards = v >= 0;
        if (r > alpha && (outwards || energy <= 1)) phase = OVERTURNED;
        else {
            if (!outwards) energy = cosq(alpha) + eta * eta * (energy - cosq(alpha));
            if (energy > 1) phase = OVERTURNED;
            else peak = fmaxq(peak, alpha - acosq(energy));
        }
    }
    if (phase == OVERTURNED) return {"overturning", HALF_PI / alpha, impacts};
    return {rocked ? "safe_rocking" : "no_rocking", peak / alpha, impacts};
}

double number() {
    std::string word;
    std::cin >> word;
    return std::strtod(word.c_str(), nullptr);
}

size_t count() { return static_cast<size_t>(number()); }

int main() {
    std::vector<Structure> structures(count());
    for (auto &s : structures) { s.p = number(); s.alpha = number(); s.eta = number(); }
    std::puts("motion_id,p_rad_s,alpha_rad,eta,outcome,edp,impacts,condition");
    for (size_t motions = count(); motions--;) {
        std::string id;
        std::cin >> id;
        Real dt = number();
        std::vector<Real> u(count()), nearby;
        for (auto &sample : u) sample = Real(number()) / G;
        const Real shift = Real(1) / 1000000000000000;
        for (Real sample : u) nearby.push_back(sample * (1 + shift));
        for (auto &s : structures) {
            Response here = simulate(s, dt, u), there = simulate(s, dt, nearby);
            Real condition = here.edp > 0 ? fabsq(there.edp / here.edp - 1) / shift : 0;
            char edp[64], sensitivity[64];
            quadmath_snprintf(edp, sizeof edp, "%.20Qe", here.edp);
            quadmath_snprintf(sensitivity, sizeof sensitivity, "%.3Qe", condition);
            std::printf("%s,%.17g,%.17g,%.17g,%s,%s,%ld,%s\n", id.c_str(), double(s.p), double(s.alpha), double(s.eta),
                        here.outcome.c_str(), edp, here.impacts, sensitivity);
        }
    }
}

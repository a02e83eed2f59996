// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/orient3d.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

constexpr double half_ulp = 0x1p-53;

/// a + b = sum + rest, exactly.
void two_sum(double a, double b, double& sum, double& rest) noexcept {
    sum = a + b;
    const double from_b = sum - a;
    rest = (a - (sum - from_b)) + (b - from_b);
}
/// a b = product + rest, exactly.
void two_product(double a, double b, double& product, double& rest) noexcept {
    product = a * b;
    rest = std::fma(a, b, -product);
}

/// A number as the sum of doubles that do not overlap, the smallest first.
template <std::size_t N>
struct Expansion {
    std::array<double, N> part{};
    std::size_t count = 0;

    void add(double value) noexcept {
        std::size_t kept = 0;
        double carry = value;
        for (std::size_t i = 0; i < count; ++i) {
            double rest;
            two_sum(carry, part[i], carry, rest);
            if (rest != 0.0) part[kept++] = rest;
        }
        if (carry != 0.0) part[kept++] = carry;
        count = kept;
    }
    [[nodiscard]] int sign() const noexcept { return count == 0 ? 0 : part[count - 1] > 0.0 ? 1 : -1; }
};

using Difference = Expansion<2>;
Difference difference(double a, double b) noexcept {
    Difference d;
    double sum, rest;
    two_sum(a, -b, sum, rest);
    if (rest != 0.0) d.part[d.count++] = rest;
    if (sum != 0.0) d.part[d.count++] = sum;
    return d;
}

/// sum += factor × a × b
template <std::size_t N, std::size_t A, std::size_t B>
void add_product(Expansion<N>& sum, double factor, const Expansion<A>& a, const Expansion<B>& b) noexcept {
    for (std::size_t i = 0; i < a.count; ++i)
        for (std::size_t j = 0; j < b.count; ++j) {
            double product, rest;
            two_product(factor * a.part[i], b.part[j], product, rest);
            sum.add(rest);
            sum.add(product);
        }
}

int exact_orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) noexcept {
    const Difference ax = difference(a.x, d.x), ay = difference(a.y, d.y), az = difference(a.z, d.z);
    const Difference bx = difference(b.x, d.x), by = difference(b.y, d.y), bz = difference(b.z, d.z);
    const Difference cx = difference(c.x, d.x), cy = difference(c.y, d.y), cz = difference(c.z, d.z);
    const auto minor = [](const Difference& px, const Difference& py, const Difference& qx, const Difference& qy) {
        Expansion<16> m;
        add_product(m, 1.0, px, qy);
        add_product(m, -1.0, py, qx);
        return m;
    };
    Expansion<192> sum;
    add_product(sum, 1.0, minor(bx, by, cx, cy), az);
    add_product(sum, 1.0, minor(cx, cy, ax, ay), bz);
    add_product(sum, 1.0, minor(ax, ay, bx, by), cz);
    return sum.sign();
}

}  // namespace

int orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) noexcept {
    const Vec3 p = a - d, q = b - d, r = c - d;
    const double qr = q.x * r.y, rq = r.x * q.y, rp = r.x * p.y, pr = p.x * r.y, pq = p.x * q.y, qp = q.x * p.y;
    const double det = p.z * (qr - rq) + q.z * (rp - pr) + r.z * (pq - qp);
    const double size = (std::abs(qr) + std::abs(rq)) * std::abs(p.z) + (std::abs(rp) + std::abs(pr)) * std::abs(q.z) +
                        (std::abs(pq) + std::abs(qp)) * std::abs(r.z);
    const double bound = (7.0 + 56.0 * half_ulp) * half_ulp * size;
    if (det > bound) return 1;
    if (-det > bound) return -1;
    return exact_orient3d(a, b, c, d);
}

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept {
    const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx), det = left - right;
    const double bound = (3.0 + 16.0 * half_ulp) * half_ulp * (std::abs(left) + std::abs(right));
    if (det > bound) return 1;
    if (-det > bound) return -1;
    Expansion<16> sum;
    add_product(sum, 1.0, difference(ax, cx), difference(by, cy));
    add_product(sum, -1.0, difference(ay, cy), difference(bx, cx));
    return sum.sign();
}

}  // namespace kerf::bone

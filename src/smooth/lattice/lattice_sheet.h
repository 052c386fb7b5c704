// Which of the sites near a quadric are on the piece of surface that it stands for.
#pragma once

#include "regionmesh/lattice.h"
#include "smooth/lattice/lattice_quadric.h"

namespace regionmesh {

/// Sites of the same interface may lie on another piece: on the other side of a thin region, on another layer, beyond
/// an edge. Told by their normals and places.
class LatticeSheet {
public:
    /// Normals face the same way above this cosine; two sides of a thin region face away from each other.
    static constexpr float kFacing = 0.2f;

    /// How closely normals must agree with the gradient of a quadric, and what share of the sites that face the same
    /// way must do so where it is accepted. In small and crumpled pieces of interfaces fewer do: what passes through
    /// these by chance is not their surface. Of those that agree, the share `missed` may be missed: single samples of
    /// another label beside a surface, as noise leaves them, make five sites each half a spacing off.
    struct Agreement {
        float cosine, share, missed;
    };
    static Agreement agreement_of(CellKind cells, bool is_anisotropic) {
        if (cells == CellKind::kCompact) return is_anisotropic ? kFarSections : kEvenSpacing;
        return is_anisotropic ? kFarTetrahedra : kTetrahedra;
    }

    LatticeSheet(const HeightQuadric& quadric, Float3 spacing, const Agreement& agreement)
        : normal_(all_four(quadric.normal)), least_cosine2_(agreement.cosine * agreement.cosine) {
        const Float3 &n = quadric.normal, along{n.x * spacing.x, n.y * spacing.y, n.z * spacing.z};
        least2_ = kRise * kRise * dot(along, along);
    }

    /// 1 to 0: how surely sites that face the same way lie on the same layer, and below on another one. `d` from the
    /// centre of the fit, where the quadric has these heights; one that is not fitted yet is the tangent plane. What
    /// lies near the quadric is on its sheet, whatever the normals say.
    Float4 share(const Lanes3<Float4>& d, const Lanes3<Float4>& normal, Float4 height) const {
        const Float4 rise = 0.5f * (dot(d, normal_) + dot(d, normal));
        const Float4 most2 = least2_ + kRisePerChord * kRisePerChord * dot(d, d),
                     part2 = least(rise * rise, height * height) / most2, part4 = part2 * part2;
        return 1 - part4 * part4;
    }

    /// Do the normals of sites agree with the gradient of the quadric there? Beside an edge of the region they do not:
    /// they lean to the other side of it, where the quadric goes on.
    Mask4 agrees(const Lanes3<Float4>& gradient, const Lanes3<Float4>& normal) const {
        const Float4 along = dot(gradient, normal);
        return along > 0 && along * along > least_cosine2_ * dot(gradient, gradient);
    }

private:
    /// Other layers are told by the chord from the centre of a fit. On a circle it is square to the mean of the normals
    /// at its ends; between two layers it rises along this mean by about their distance. The rise that is allowed: so
    /// many spacings along the normal, and this share of the chord, since normals on terraces are rough.
    static constexpr float kRise = 2, kRisePerChord = 0.3f;

    /// Normals are averages: at a right edge they lean by 45 degrees, one site farther in by less; on terraces they
    /// lean more, and most those of tetrahedra. Compact cells: a cosine of 0.8 makes small balls worse (radius 5: 3.9
    /// instead of 3.7 degrees), 0.7 cubes (3.9 instead of 2.7); a share of 0.8 leaves cubes round (5.8 degrees); with
    /// none, normals of neighbouring faces differ by 1.3 % more in crops of an atlas and of neurons. Far sections: with
    /// a cosine of 0.7 a plane of slope 1:8 gets 5.0 instead of 3.4 degrees, with a share of 0.7 a torus 16.0 instead
    /// of 12.7. Tetrahedra: with a cosine of 0.75 planes of slope 1:15 get 0.7 instead of 0.4 degrees; between far
    /// sections even 0.4 makes balls 7 % worse, so there nearly every normal agrees, and no site may be missed: with a
    /// share of 0.15 a ball of radius 5 gets 20 instead of 17 degrees at 1:5. Elsewhere a quarter gains nothing more.
    static constexpr Agreement kEvenSpacing{0.75f, 0.7f, 0.15f}, kFarSections{0.6f, 0.8f, 0.15f},
        kTetrahedra{0.6f, 0.7f, 0.15f}, kFarTetrahedra{0, 0.01f, 0};

    Lanes3<Float4> normal_;
    float least_cosine2_, least2_;
};

}  // namespace regionmesh

#include "volume/region_numbers.h"

namespace regionmesh {

RegionNumbers::RegionNumbers(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), stride_(std::size_t{width} + 1) {
    restart();
}

void RegionNumbers::restart() {
    for (Layer* layer : {&before_, &now_}) {
        layer->numbers.assign(stride_ * (std::size_t{height_} + 1), kNone);
        layer->labels.assign(stride_ * (std::size_t{height_} + 1), 0);
    }
    count_ = 0;
}

}  // namespace regionmesh

// A table of the regions of a model: regions MODEL TABLE.csv
#include <regionmesh/formats.h>
#include <regionmesh/regionmesh.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: regions MODEL TABLE.csv\n");
        return 2;
    }
    try {
        regionmesh::MeshFile file = regionmesh::read_mesh(argv[1]);
        std::vector<regionmesh::Label> background;
        if (file.background)
            for (const regionmesh::InputLabel label : *file.background) background.push_back(file.labels.dense(label));
        regionmesh::write_text(argv[2], regionmesh::regions_csv(file.mesh, file.labels, background, file.names));
        return 0;
    } catch (const regionmesh::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

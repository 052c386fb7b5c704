// Shell scripts in a temporary folder that stand for programs.
#pragma once

#include "formats/temporary_folder.h"

namespace regionmesh {

class FakePrograms : public TemporaryFolder {
protected:
    /// A program that does what `lines` say.
    std::filesystem::path program(const std::string& lines) const {
        const auto file = path("program");
        put_text(file, "#!/bin/sh\n" + lines + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file;
    }
};

}  // namespace regionmesh

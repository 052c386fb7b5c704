# Makes a tension test for CalculiX of a mesh that Gmsh wrote: awk -f tension.awk MESH.inp > tension.inp
# Needs the node sets of the box (gmsh -setnumber Mesh.SaveGroupsOfNodes 1). The box is pulled by 0.1 % along z; three of
# its sides keep their planes, so that it may contract freely. Each region has a material of its own: edit them below.

/^\*/ {
    # Surface elements stand in the file because their groups do; a solver would ask for their material.
    keep = !/CPS3/ && !/ELSET=(interface_|[XYZ]M(IN|AX))/
    in_nodes = /^\*NODE/
    if (keep && /^\*ELSET/) { name = $0; sub(/.*ELSET=/, "", name); regions[++count] = name }
    if (keep) print
    next
}
in_nodes {
    split($0, node, ",")
    if (!seen++ || node[4] + 0 < low) low = node[4] + 0
    if (seen == 1 || node[4] + 0 > high) high = node[4] + 0
}
keep { print }

END {
    for (n = 1; n <= count; ++n) {
        printf "*MATERIAL, NAME=%s\n*ELASTIC\n%g, 0.3\n", regions[n], 200000 + 1000 * n
        printf "*SOLID SECTION, ELSET=%s, MATERIAL=%s\n", regions[n], regions[n]
    }
    print "*STEP\n*STATIC\n*BOUNDARY\nXMIN, 1, 1\nYMIN, 2, 2\nZMIN, 3, 3"
    printf "ZMAX, 3, 3, %.12g\n", 0.001 * (high - low)
    print "*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT, NSET=ZMAX, TOTALS=ONLY\nRF\n*END STEP"
}

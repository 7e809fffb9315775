# SPDX-License-Identifier: BSD-3-Clause
"""POV-Ray files with one mesh2: left-handed, so z is mirrored."""

from geometry import number


def _short(value, digits):
    text = number(value, digits)
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text


def _vectors(rows, digits, per_line=6):
    texts = ["<" + ",".join(_short(c, digits) for c in row) + ">" for row in rows]
    lines = [",".join(texts[k:k + per_line]) for k in range(0, len(texts), per_line)]
    return f"{len(texts)},\n" + ",\n".join(lines)


def document(comment, name, mesh, texture, digits=3):
    """The text of a file that declares a mesh2 `name` with normals and texture coordinates and shows it."""
    normals = mesh.vertex_normals()
    points, index, rows = [], {}, []
    for _, corners in mesh.triangles():
        row = []
        for vertex, uv in corners:
            key = (vertex, tuple(number(c, 3) for c in uv))
            if key not in index:
                index[key] = len(points)
                points.append(key)
            row.append(index[key])
        rows.append((row[0], row[2], row[1]))
    places = [mesh.vertices[v] for v, _ in points]
    return (f"// {comment}\n"
            f"#declare {name} = mesh2 {{\n"
            f"  vertex_vectors {{ {_vectors([(x, y, -z) for x, y, z in places], digits)} }}\n"
            f"  normal_vectors {{ {_vectors([(normals[v][0], normals[v][1], -normals[v][2]) for v, _ in points], 2, 8)} }}\n"
            f"  uv_vectors {{ {_vectors([tuple(float(c) for c in uv) for _, uv in points], 3, 8)} }}\n"
            f"  face_indices {{ {_vectors(rows, 0, 8)} }}\n"
            f"  {texture}\n"
            f"}}\n"
            f"object {{ {name} }}\n")


def image_texture(picture, specular):
    return (f'texture {{ uv_mapping pigment {{ image_map {{ png "{picture}" interpolate 2 }} }} '
            f"finish {{ ambient 0.2 diffuse 0.8 specular {number(specular)} roughness 0.02 }} }}")

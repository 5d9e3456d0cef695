"""Open3D's registration of pairs of meshes, beside which `automorph_bench registration --open3d` puts ours.

The route of Open3D's own tutorial: both shapes are brought to one size and thinned out to voxels, FPFH features are
matched by RANSAC, and point-to-plane ICP follows. Reads k_a.ply and k_b.ply for k = 0, 1, ... of a folder and writes
one line per pair to its rotations.txt: nine numbers, row by row, and the seconds it took.
"""

import pathlib
import sys
import time

import numpy as np
import open3d as o3d

VOXEL = 0.04  # of the size, which is twice the root mean square distance from the middle


def cloud(path):
    mesh = o3d.io.read_triangle_mesh(str(path))
    mesh.compute_vertex_normals()
    points = np.asarray(mesh.vertices)
    points = points - points.mean(axis=0)
    points = points / (2.0 * np.sqrt((points**2).sum(axis=1).mean()))
    result = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    result.normals = mesh.vertex_normals
    return result


def features(points):
    thin = points.voxel_down_sample(VOXEL)
    thin.normalize_normals()
    around = o3d.geometry.KDTreeSearchParamHybrid(radius=5.0 * VOXEL, max_nn=100)
    return thin, o3d.pipelines.registration.compute_fpfh_feature(thin, around)


def rotation(a, b):
    reg = o3d.pipelines.registration
    (thin_a, features_a), (thin_b, features_b) = features(a), features(b)
    near = 1.5 * VOXEL
    found = reg.registration_ransac_based_on_feature_matching(
        thin_a, thin_b, features_a, features_b, True, near,
        reg.TransformationEstimationPointToPoint(False), 3,
        [reg.CorrespondenceCheckerBasedOnEdgeLength(0.9), reg.CorrespondenceCheckerBasedOnDistance(near)],
        reg.RANSACConvergenceCriteria(100000, 0.999))
    fine = reg.registration_icp(a, b, near, found.transformation, reg.TransformationEstimationPointToPlane())
    return fine.transformation[:3, :3]


def main():
    folder = pathlib.Path(sys.argv[1])
    o3d.utility.random.seed(1)
    lines = []
    for k in range(len(list(folder.glob("*_a.ply")))):
        a, b = cloud(folder / f"{k}_a.ply"), cloud(folder / f"{k}_b.ply")
        start = time.process_time()
        R = rotation(a, b)
        lines.append(" ".join(repr(float(x)) for x in R.ravel()) + f" {time.process_time() - start}")
    (folder / "rotations.txt").write_text("\n".join(lines) + "\n")


main()

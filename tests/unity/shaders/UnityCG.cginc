// What the package uses of Unity's header of this name.
float4x4 unity_MatrixV, glstate_matrix_projection;
#define UNITY_MATRIX_V unity_MatrixV
#define UNITY_MATRIX_P glstate_matrix_projection

// SPDX-License-Identifier: Apache-2.0
#include "bench/flying_edges.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>

#include <algorithm>

struct FlyingEdges::Image {
    vtkSmartPointer<vtkImageData> data = vtkSmartPointer<vtkImageData>::New();
};

FlyingEdges::FlyingEdges(std::array<int, 3> size, double spacing, std::array<double, 3> origin,
                         const std::vector<float>& samples)
    : image_(std::make_unique<Image>()) {
    vtkSMPTools::Initialize(1);
    image_->data->SetDimensions(size[0], size[1], size[2]);
    image_->data->SetSpacing(spacing, spacing, spacing);
    image_->data->SetOrigin(origin[0], origin[1], origin[2]);
    image_->data->AllocateScalars(VTK_FLOAT, 1);
    std::copy(samples.begin(), samples.end(), static_cast<float*>(image_->data->GetScalarPointer()));
}

FlyingEdges::~FlyingEdges() = default;

std::size_t FlyingEdges::mesh() const {
    const auto edges = vtkSmartPointer<vtkFlyingEdges3D>::New();
    edges->SetInputData(image_->data);
    edges->ComputeNormalsOn();
    edges->ComputeGradientsOff();
    edges->ComputeScalarsOff();
    edges->SetValue(0, 0.0);
    edges->Update();
    return static_cast<std::size_t>(edges->GetOutput()->GetNumberOfPolys());
}

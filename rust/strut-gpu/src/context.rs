//! The GPU: its properties, its limits, and its state.

use crate::error::GpuError;
use crate::readback::Readback;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Description of a GPU and its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adapter {
    /// Name of the GPU.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Vulkan or Metal.
    pub backend: String,
    /// Whether the GPU is emulated in software: results are meaningful, times are not.
    pub is_software: bool,
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.backend, self.driver)?;
        if self.is_software { f.write_str(", in software") } else { Ok(()) }
    }
}

/// An open GPU; copies share it.
#[derive(Clone, Debug)]
pub struct Context {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter: Adapter,
    /// Compiled kernels by shader: a driver may take seconds for one.
    kernels: Arc<Mutex<Vec<(&'static str, wgpu::ComputePipeline)>>>,
    /// Error that the device reported outside of any call; a loss is permanent.
    fault: Arc<Mutex<Option<GpuError>>>,
}

impl Context {
    /// Opens the fastest GPU, and waits for it.
    ///
    /// # Errors
    /// If there is no GPU, or it cannot be opened.
    #[cfg(not(target_family = "wasm"))]
    pub fn new() -> Result<Self, GpuError> {
        pollster::block_on(Self::open())
    }

    /// Opens the fastest GPU.
    ///
    /// # Errors
    /// If there is no GPU, or it cannot be opened.
    pub async fn open() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..wgpu::RequestAdapterOptions::default()
        };
        let adapter =
            instance.request_adapter(&options).await.map_err(|error| GpuError::NoAdapter(one_line(&error)))?;
        let had = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits {
                max_storage_buffer_binding_size: had.max_storage_buffer_binding_size,
                max_buffer_size: had.max_buffer_size,
                ..wgpu::Limits::default()
            },
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) =
            adapter.request_device(&descriptor).await.map_err(|error| GpuError::NoDevice(one_line(&error)))?;
        let fault = Arc::new(Mutex::new(None));
        let set = |fault: &Mutex<Option<GpuError>>, error| {
            let mut fault = fault.lock().unwrap_or_else(PoisonError::into_inner);
            if !matches!(*fault, Some(GpuError::Lost(_))) {
                *fault = Some(error);
            }
        };
        let lost = Arc::clone(&fault);
        device.set_device_lost_callback(move |_, message| set(&lost, GpuError::Lost(one_line(&message))));
        // Without a handler wgpu ends the program.
        let failed = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error| set(&failed, GpuError::Failed(one_line(&error)))));
        let info = adapter.get_info();
        let adapter = Adapter {
            name: info.name,
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            backend: info.backend.to_string(),
            is_software: info.device_type == wgpu::DeviceType::Cpu,
        };
        Ok(Self { device, queue, adapter, kernels: Arc::default(), fault })
    }

    /// Returns the description of the GPU.
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Simulates device loss.
    pub fn destroy(&self) {
        self.device.destroy();
    }

    /// Returns the greatest number of bytes of a storage buffer.
    pub(crate) fn binding_limit(&self) -> u64 {
        let limits = self.device.limits();
        limits.max_storage_buffer_binding_size.min(limits.max_buffer_size)
    }

    /// Returns the greatest number of workgroups in a row.
    pub(crate) fn workgroup_limit(&self) -> u64 {
        self.device.limits().max_compute_workgroups_per_dimension.into()
    }

    /// Creates a buffer of at least one word.
    ///
    /// # Errors
    /// If it is too large for a binding.
    pub(crate) fn buffer(&self, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
        let limit = self.binding_limit();
        if bytes > limit {
            return Err(GpuError::TooLarge { bytes, limit });
        }
        let descriptor = wgpu::BufferDescriptor { label: None, size: bytes.max(4), usage, mapped_at_creation: false };
        Ok(self.device.create_buffer(&descriptor))
    }

    /// Creates a storage buffer with these contents.
    ///
    /// # Errors
    /// If it is too large for a binding.
    pub(crate) fn storage(&self, contents: &[u8]) -> Result<wgpu::Buffer, GpuError> {
        let buffer = self.buffer(contents.len() as u64, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST)?;
        self.write(&buffer, contents);
        Ok(buffer)
    }

    /// Writes bytes to the start of a buffer.
    pub(crate) fn write(&self, buffer: &wgpu::Buffer, contents: &[u8]) {
        self.queue.write_buffer(buffer, 0, contents);
    }

    /// Returns the function `main` of a shader, compiled once.
    pub(crate) fn kernel(&self, shader: &'static str) -> wgpu::ComputePipeline {
        let mut kernels = self.kernels.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kernel)) = kernels.iter().find(|(of, _)| *of == shader) {
            return kernel.clone();
        }
        let kernel = self.compile(shader);
        kernels.push((shader, kernel.clone()));
        kernel
    }

    fn compile(&self, shader: &'static str) -> wgpu::ComputePipeline {
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(shader.into()),
        });
        self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    }

    /// Binds whole buffers in the order of their bindings.
    pub(crate) fn bind(&self, kernel: &wgpu::ComputePipeline, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let layout = kernel.get_bind_group_layout(0);
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries })
    }

    /// Runs kernels one after the other, each on its number of workgroups, and reads the first words of a result
    /// through a readback buffer.
    ///
    /// # Errors
    /// If the device is lost or rejects a command.
    pub(crate) async fn run(
        &self,
        passes: &[(&wgpu::ComputePipeline, &wgpu::BindGroup, [u32; 2])],
        [result, reading]: [&wgpu::Buffer; 2],
        words: usize,
    ) -> Result<Vec<u32>, GpuError> {
        let bytes = 4 * words as u64;
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (kernel, bindings, [x, y]) in passes {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(kernel);
            pass.set_bind_group(0, *bindings, &[]);
            pass.dispatch_workgroups(*x, *y, 1);
        }
        encoder.copy_buffer_to_buffer(result, 0, reading, 0, bytes);
        self.queue.submit([encoder.finish()]);
        let mapping = Readback::of(reading, bytes);
        // In a browser this does nothing: the mapping resolves without it.
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        waited.map_err(|error| GpuError::Failed(one_line(&error)))?;
        let mapped = mapping.await;
        self.check()?;
        mapped.map_err(|error| GpuError::Failed(one_line(&error)))?;
        let view = reading.get_mapped_range(..bytes).map_err(|error| GpuError::Failed(one_line(&error)))?;
        let out = view.chunks_exact(4).map(|word| u32::from_ne_bytes([word[0], word[1], word[2], word[3]])).collect();
        drop(view);
        reading.unmap();
        Ok(out)
    }

    /// Checks for errors that the device has reported since the last check.
    ///
    /// # Errors
    /// The reported error.
    pub(crate) fn check(&self) -> Result<(), GpuError> {
        let mut fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        let found = fault.clone();
        if !matches!(found, Some(GpuError::Lost(_))) {
            *fault = None;
        }
        found.map_or(Ok(()), Err)
    }
}

/// Returns a message on one line.
fn one_line(message: &impl ToString) -> String {
    message.to_string().split_whitespace().collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}

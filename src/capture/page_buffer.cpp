// page_buffer.cpp
